// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/headless.h"

namespace afterglow {

/// The exit codes of the program.
enum ExitCode {
    kDone = 0,
    kFailed = 1,
    kWrongUsage = 2,
    kBadInput = 3,
    kNoContext = 4,
    kInterrupted = 130 ///< as shells report a program that Ctrl-C ended
};

/// The whole program: parses the words, runs the subcommand, and turns whatever goes wrong into one
/// line on standard error and an exit code.
int runCommandLine(int argc, const char* const* argv, HiddenContextFactory hiddenContext);

} // namespace afterglow
