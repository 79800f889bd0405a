# SPDX-License-Identifier: MIT
# compile_together(<target>) compiles those sources of a target in groups that include a header of which every
# file that includes it pays for seconds: JSON and the command line. A few of them then take little longer than one.
# The dev and asan presets compile each by itself, so that a file which lacks an include does not go unnoticed.
function(compile_together target)
    if(NOT AFTERGLOW_TOGETHER)
        return()
    endif()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    get_target_property(sources ${target} SOURCES)
    foreach(header nlohmann/json CLI/CLI)
        set(found "")
        foreach(source IN LISTS sources)
            if(EXISTS ${source}) # else it will be generated
                file(STRINGS ${source} lines REGEX "^#include <${header}\\.hpp>")
                if(lines)
                    list(APPEND found ${source})
                endif()
            endif()
        endforeach()
        list(LENGTH found count)
        math(EXPR groups "(${count} + 4) / 5") # of five at most
        foreach(source IN LISTS found)
            math(EXPR count "${count} - 1")
            math(EXPR group "${count} % ${groups}")
            string(MAKE_C_IDENTIFIER "${header}_${group}" name)
            set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${name})
        endforeach()
    endforeach()
endfunction()
