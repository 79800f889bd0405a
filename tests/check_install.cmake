# SPDX-License-Identifier: MIT
# Installs the program, moves the tree, and asks whether it stands on its own: every library that it
# loads lies in the tree or is one that any Linux has, and it renders a scene of the tree.
# Usage: cmake -DBUILD=FOLDER -DOUT=FOLDER -P check_install.cmake
file(REMOVE_RECURSE ${OUT})
function(run_or_fail result)
    execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE code)
    if(NOT code EQUAL 0)
        message(FATAL_ERROR "${ARGN}: ${code}\n${output}")
    endif()
    set(${result} "${output}" PARENT_SCOPE)
endfunction()

run_or_fail(ignored ${CMAKE_COMMAND} --install ${BUILD} --prefix ${OUT}/made)
file(RENAME ${OUT}/made ${OUT}/moved)
set(tree ${OUT}/moved)

run_or_fail(libraries ldd ${tree}/bin/afterglow)
string(REGEX MATCHALL "[^\n\t ]+ => [^\n]+" lines "${libraries}")
set(own 0)
foreach(line IN LISTS lines)
    if(line MATCHES "^lib(c|m|dl|rt|pthread|gcc_s|stdc\\+\\+)\\.so")
        continue()
    endif()
    string(REGEX REPLACE ".* => ([^ ]+).*" "\\1" path "${line}")
    get_filename_component(path "${path}" ABSOLUTE)
    string(FIND "${path}" "${tree}/" place)
    if(NOT place EQUAL 0)
        message(FATAL_ERROR "the installed program takes a library from elsewhere: ${line}")
    endif()
    math(EXPR own "${own} + 1")
endforeach()
if(own EQUAL 0)
    message(FATAL_ERROR "no library in the tree was found:\n${libraries}")
endif()

run_or_fail(ignored ${CMAKE_COMMAND} -E env --unset=LD_LIBRARY_PATH ${tree}/bin/afterglow render
    ${tree}/share/afterglow/assets/scenes/cornell.gltf --frames 1 --size 61x37 --out ${OUT}/frame)
if(NOT EXISTS ${OUT}/frame/color_0000.png)
    message(FATAL_ERROR "the installed program left no picture")
endif()
file(REMOVE_RECURSE ${OUT})
