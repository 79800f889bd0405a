// SPDX-License-Identifier: MIT
#pragma once

#include "app/bench/figures.h"

#include <chrono>
#include <string>
#include <vector>

namespace afterglow {

/// Points in time of a start, by the clock that all processes of a machine share.
struct StartupTimes {
    using Point = std::chrono::steady_clock::time_point;
    Point command;       ///< the command begins: libraries are loaded, options are read
    Point scene;         ///< the scene is in memory
    Point context;       ///< there is an OpenGL context
    Point programs;      ///< the shaders that are known before the first frame are compiled
    Point upload;        ///< the scene is on the device, its tree is built
    Point first, second; ///< the device has finished these frames
    double bvhMilliseconds = 0.0; ///< of the time until `upload`
};

/// One line, from which the process that has started this one reads the times.
std::string lineOf(const StartupTimes& times);
/// Reads such a line, which may stand behind others. Error where there is none.
StartupTimes startupTimesIn(std::string_view output);

/// Milliseconds of the phases from the begin of a process to its first frame.
struct StartupFigures {
    struct Phase {
        std::string name;
        Spread cold, warm; ///< with an empty cache of compiled shaders, and with what that has left
    };
    std::vector<Phase> phases; ///< the last two: "total" of those before, and "second frame"
};

/// Starts this program with these words, which make it print its times, twice a repeat: with caches
/// in an empty folder, and with the same folder again. Error if it fails.
StartupFigures measureStartup(const std::vector<std::string>& words, int repeats);

void addTo(Figures& figures, const std::string& subject, const StartupFigures& startup);
std::string tableOf(const StartupFigures& startup);

} // namespace afterglow
