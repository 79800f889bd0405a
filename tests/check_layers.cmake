# SPDX-License-Identifier: MIT
# Fails when an include under renderer/ or app/ points to a layer that its own may not know.
# Usage: cmake -DROOT=<source dir> -P check_layers.cmake

cmake_minimum_required(VERSION 3.22)

set(base_may "base")
set(image_may "base;image")
set(scene_may "base;image;scene")
set(bvh_may "base;image;scene;bvh")
set(gl_may "base;image;gl")
set(resources_may "base;image;scene;bvh;gl;resources")
set(passes_may "base;image;scene;bvh;gl;resources;passes")
set(filters_may "base;image;scene;bvh;gl;resources;passes;filters")
set(pipeline_may "base;image;scene;bvh;gl;resources;passes;filters;pipeline")

# Folders of app/. All may know the renderer.
set(app_base_may "base")
set(app_scenario_may "base;scenario")
set(app_measure_may "base;scenario;measure")
set(app_bench_may "base;bench")
set(app_report_may "base;scenario;measure;report")
set(app_experiment_may "base;scenario;measure;report;experiment")
set(app_workbench_may "base;scenario;measure;report;experiment;workbench")
set(app_ui_may "base;scenario;measure;report;experiment;workbench;ui")
set(app_window_may "base;scenario;measure;report;experiment;workbench;ui;window")
set(app_commands_may "base;scenario;measure;report;experiment;workbench;ui;window;bench;commands")

# Foreign libraries and the files that may see them.
set(foreign
    "tiny_gltf.h|renderer/scene/"
    "stb/|renderer/image/|app/report/"
    "stb_|renderer/image/|app/report/"
    "tinyexr.h|renderer/image/"
    "GL/osmesa.h|renderer/gl/context_osmesa.cpp"
    "EGL/|renderer/gl/context_egl.cpp"
    "embree3/|app/bench/embree/"
    "GLFW/|app/window/|app/ui/"
    "imgui|app/window/|app/ui/"
    "CLI/|app/commands/")

set(faults "")
set(seen 0)
file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/renderer/*.h ${ROOT}/renderer/*.cpp ${ROOT}/app/*.h ${ROOT}/app/*.cpp)
foreach(file IN LISTS files)
    file(STRINGS ${ROOT}/${file} includes REGEX "^#include")
    foreach(line IN LISTS includes)
        math(EXPR seen "${seen} + 1")
        if(file MATCHES "^renderer/([a-z]+)/")
            set(layer ${CMAKE_MATCH_1})
            if(line MATCHES "\"renderer/([a-z]+)/" AND NOT CMAKE_MATCH_1 IN_LIST ${layer}_may)
                string(APPEND faults "${file}: ${layer} may not know ${CMAKE_MATCH_1}: ${line}\n")
            endif()
            if(line MATCHES "\"(app|tests)/")
                string(APPEND faults "${file}: the renderer may not know ${CMAKE_MATCH_1}: ${line}\n")
            endif()
        endif()
        if(file MATCHES "^app/([a-z]+)/")
            set(folder ${CMAKE_MATCH_1})
            if(DEFINED app_${folder}_may AND line MATCHES "\"app/([a-z]+)/" AND NOT CMAKE_MATCH_1 IN_LIST app_${folder}_may)
                string(APPEND faults "${file}: app/${folder} may not know app/${CMAKE_MATCH_1}: ${line}\n")
            endif()
        endif()
        foreach(rule IN LISTS foreign)
            string(REPLACE "|" ";" parts "${rule}")
            list(POP_FRONT parts header)
            if(line MATCHES "[<\"/]${header}")
                set(allowed FALSE)
                foreach(place IN LISTS parts)
                    if(file MATCHES "^${place}")
                        set(allowed TRUE)
                    endif()
                endforeach()
                if(NOT allowed)
                    string(APPEND faults "${file}: only ${parts} may see ${header}: ${line}\n")
                endif()
            endif()
        endforeach()
    endforeach()
endforeach()

if(seen LESS 100)
    message(FATAL_ERROR "only ${seen} includes seen below ${ROOT}: is it the source folder?")
endif()
if(faults)
    message(FATAL_ERROR "\n${faults}")
endif()
message(STATUS "${seen} includes, all pointing down")
