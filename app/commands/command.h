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

/// A row of the list of commands.
struct CommandRow {
    const char *name, *help;
    std::unique_ptr<Command> (*make)(Options& options);
};
template <class Made>
std::unique_ptr<Command> make(Options& options) {
    return std::make_unique<Made>(options);
}

// Each is in the file of its command.
extern const CommandRow kViewCommand, kRenderCommand, kExperimentCommand, kSweepCommand,
    kMergeCommand, kReportCommand, kImportFramesCommand, kBenchCommand, kListCommand;

} // namespace afterglow
