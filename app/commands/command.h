// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/headless.h"
#include "app/commands/options.h"

namespace afterglow {

/// A command of the program. Its constructor adds its options, which are its members.
class Command {
public:
    Command() = default;
    virtual ~Command() = default;
    Command(const Command&) = delete;
    Command& operator=(const Command&) = delete;

    /// Runs the command, once the options have been read.
    virtual void run(HiddenContextFactory hiddenContext) = 0;
};

using MadeCommand = std::unique_ptr<Command>;

// One file each.
MadeCommand viewCommand(Options& options);
MadeCommand renderCommand(Options& options);
MadeCommand experimentCommand(Options& options);
MadeCommand sweepCommand(Options& options);
MadeCommand mergeCommand(Options& options);
MadeCommand reportCommand(Options& options);
MadeCommand importCommand(Options& options);
MadeCommand benchCommand(Options& options);
MadeCommand listCommand(Options& options);

} // namespace afterglow
