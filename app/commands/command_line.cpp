// SPDX-License-Identifier: MIT
#include "app/commands/command_line.h"

#include "app/base/output.h"
#include "app/base/progress.h"
#include "app/commands/command.h"
#include "renderer/base/error.h"
#include "renderer/base/names.h"
#include "renderer/gl/errors.h"

#include <algorithm>
#include <exception>
#include <new>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace afterglow {

namespace {

constexpr const CommandRow* kCommands[] = {
    &kViewCommand,   &kRenderCommand,       &kExperimentCommand, &kSweepCommand, &kMergeCommand,
    &kReportCommand, &kImportFramesCommand, &kBenchCommand,      &kListCommand};

/// A command with its place in the parser.
struct Parsed {
    const CommandRow& row;
    CLI::App& app;
    Options options{app};
    std::unique_ptr<Command> command;

    Parsed(CLI::App& parent, const CommandRow& chosen)
        : row(chosen), app(*parent.add_subcommand(row.name, row.help)), command(row.make(options)) {
    }
};

// What the parser could make nothing of: a word that is no subcommand, an option that is unknown,
// or one word too many.
void refuseExtras(const CLI::App& app, const CLI::App* command) {
    const CLI::App& place = command ? *command : app;
    const auto extras = place.remaining(false);
    if (extras.empty())
        return;
    const std::string prefix = command ? command->get_name() + ": " : "";
    const std::string& word = extras.front();
    const bool isOption = word.size() > 1 && word[0] == '-';
    std::vector<std::string> names;
    if (isOption) {
        for (const CLI::Option* option : place.get_options())
            for (const std::string& name : option->get_lnames())
                names.push_back("--" + name);
    } else if (!command) {
        for (const CommandRow* row : kCommands)
            names.emplace_back(row->name);
    } else {
        throw UsageError(prefix + "one word too many: '" + word + "'");
    }
    const std::string name = word.substr(0, isOption ? word.find('=') : std::string::npos);
    throw UsageError(
        prefix + unknownName(isOption ? "option" : "command", name, {names.begin(), names.end()}));
}

int parseAndRun(int argc, const char* const* argv, HiddenContextFactory hiddenContext) {
    CLI::App app("Afterglow: a workbench for adaptive temporal filtering of path-traced light "
                 "(SVGF and A-SVGF).");
    app.name("afterglow");
    app.set_version_flag("--version", "afterglow " + std::string(version()));
    Options(app).setFooter(R"(afterglow COMMAND --help tells more.

Examples:
  afterglow view hall
  afterglow render cornell --out out/cornell
  afterglow experiment light-off --out out/light-off
  afterglow list scenes)");
    std::vector<std::unique_ptr<Parsed>> commands;
    for (const CommandRow* row : kCommands)
        commands.push_back(std::make_unique<Parsed>(app, *row));
    const auto chosen = [&]() -> Parsed* {
        const auto found = std::ranges::find_if(
            commands, [](const auto& command) { return command->app.parsed(); });
        return found == commands.end() ? nullptr : found->get();
    };
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& asked) { // --help, --version
        return app.exit(asked);
    } catch (const CLI::ParseError& error) {
        // A misspelt name is the better explanation of a missing one.
        const CLI::App* command = chosen() ? &chosen()->app : nullptr;
        refuseExtras(app, command);
        throw UsageError((command ? command->get_name() + ": " : "") + error.what());
    }
    Parsed* command = chosen();
    refuseExtras(app, command ? &command->app : nullptr);
    if (!command) {
        std::vector<std::string> names;
        for (const CommandRow* row : kCommands)
            names.emplace_back(row->name);
        throw UsageError(
            fmt::format("a command is missing: {}; see afterglow --help", fmt::join(names, ", ")));
    }
    command->options.read();
    const int glErrors = glErrorCount();
    command->command->run(hiddenContext);
    if (&command->row != &kViewCommand) // whose window has said so meanwhile
        requireNoGlErrors(glErrors);
    return kDone;
}

int fail(int code, std::string message) {
    std::ranges::replace(message, '\n', ' ');
    fmt::print(stderr, "afterglow: {}\n", message);
    return code;
}

} // namespace

int runCommandLine(int argc, const char* const* argv, HiddenContextFactory hiddenContext) {
    try {
        return parseAndRun(argc, argv, hiddenContext);
    } catch (const UsageError& error) {
        return fail(kWrongUsage, error.what());
    } catch (const InputError& error) {
        return fail(kBadInput, error.what());
    } catch (const ContextError& error) {
        return fail(kNoContext, error.what());
    } catch (const Interrupted& interrupted) {
        return fail(kInterrupted, interrupted.what());
    } catch (const std::bad_alloc&) {
        return fail(kFailed, "out of memory");
    } catch (const std::exception& error) {
        return fail(kFailed, error.what());
    }
}

} // namespace afterglow
