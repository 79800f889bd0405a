// SPDX-License-Identifier: MIT
#include "app/commands/command_line.h"

#include "app/base/interrupt.h"
#include "app/base/output.h"
#include "app/commands/arguments.h"
#include "app/commands/command_words.h"
#include "app/commands/exchange_words.h"
#include "app/commands/experiment_words.h"
#include "app/commands/headless.h"
#include "app/commands/list.h"
#include "renderer/base/error.h"
#include "renderer/gl/errors.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>

namespace afterglow {

namespace {

/// Everything that can stand on the command line.
struct Words {
    Text kind;
    RenderWords render;
    ViewWords view;
    ExperimentWords experiment;
    SweepWords sweep;
    MergeWords merge;
    ReportWords report;
    ImportWords import;
    BenchWords bench;
};

std::string listed(std::span<const std::string_view> names) {
    std::string text;
    for (std::string_view name : names)
        text += (text.empty() ? "" : ", ") + std::string(name);
    return text;
}

CLI::App* chosen(CLI::App& app) {
    const auto commands = app.get_subcommands();
    return commands.empty() ? nullptr : commands.front();
}

// What the parser could make nothing of: a word that is no subcommand, an option that is unknown,
// or one word too many.
void refuseExtras(CLI::App& app) {
    CLI::App* command = chosen(app);
    CLI::App& speaker = command ? *command : app;
    const auto extras = speaker.remaining(false);
    if (extras.empty())
        return;
    const std::string& word = extras.front();
    const std::string place = command ? command->get_name() + ": " : "";
    std::vector<std::string> names;
    const bool isOption = word.size() > 1 && word[0] == '-';
    if (isOption) {
        for (const CLI::Option* option : speaker.get_options())
            for (const std::string& name : option->get_lnames())
                names.push_back("--" + name);
    } else if (!command) {
        for (const CLI::App* sub : app.get_subcommands([](CLI::App*) { return true; }))
            names.push_back(sub->get_name());
    } else {
        throw UsageError(place + "one word too many: '" + word + "'");
    }
    const std::string name = word.substr(0, isOption ? word.find('=') : std::string::npos);
    throw UsageError(
        place + unknownName(isOption ? "option" : "command", name, {names.begin(), names.end()}));
}

int dispatch(CLI::App& app, const Words& words, HiddenContextFactory hiddenContext) {
    const std::string command = chosen(app) ? chosen(app)->get_name() : "";
    const int glErrors = glErrorCount();
    if (command == "render" && words.render.exports) {
        runExportCommand(words.render.parseExport(), hiddenContext);
    } else if (command == "render") {
        runRender(words.render.parse(), hiddenContext);
    } else if (command == "experiment") {
        runExperimentCommand(words.experiment.parse(), hiddenContext);
    } else if (command == "sweep") {
        runSweepCommand(words.sweep.experiment.parse(), words.sweep.parseSweep(), hiddenContext);
    } else if (command == "merge") {
        runMergeCommand({words.merge.parts.begin(), words.merge.parts.end()}, *words.merge.out,
                        words.merge.fresh);
    } else if (command == "report") {
        runReportCommand(*words.report.folder);
    } else if (command == "import-frames") {
        runImportCommand(words.import.parse(), hiddenContext);
    } else if (command == "bench") {
        runBench(words.bench.parse(), hiddenContext);
    } else if (command == "list") {
        runList(*words.kind);
    } else if (command == "view") {
        runView(words.view.parse());
        return kDone;
    } else {
        throw UsageError("a command is missing: view, render, experiment, sweep, merge, report, "
                         "import-frames, bench or list; see afterglow --help");
    }
    requireNoGlErrors(glErrors);
    return kDone;
}

int parseAndRun(int argc, const char* const* argv, HiddenContextFactory hiddenContext) {
    CLI::App app("Afterglow: a workbench for adaptive temporal filtering of path-traced light "
                 "(SVGF and A-SVGF).");
    app.name("afterglow");
    app.set_version_flag("--version", "afterglow " + std::string(version()));
    app.get_formatter()->column_width(32);
    app.allow_extras();
    app.footer("afterglow COMMAND --help tells more.\n\n"
               "Examples:\n"
               "  afterglow view hall\n"
               "  afterglow render cornell --out out/cornell\n"
               "  afterglow experiment light-off --out out/light-off\n"
               "  afterglow list scenes\n\n" +
               kExitCodes);

    Words words;
    const auto command = [&](const char* name, const char* help) -> CLI::App& {
        CLI::App* sub = app.add_subcommand(name, help)->allow_extras();
        sub->get_formatter()->column_width(32);
        return *sub;
    };
    words.view.addTo(command("view", "Opens a window on a scene"));
    words.render.addTo(command("render", "Renders frames into files"));
    words.experiment.addTo(
        command("experiment", "Compares filters while something changes, and measures them"));
    words.sweep.addTo(
        command("sweep", "Runs an experiment for each value of a setting: noise against lag"));
    words.merge.addTo(command("merge", "Puts the parts of a run together"));
    words.report.addTo(command("report", "Makes the page of a run anew"));
    words.import.addTo(
        command("import-frames", "Scores the frames of another denoiser beside our filters"));
    words.bench.addTo(command("bench", "Measures how long frames and passes take"));
    CLI::App& list = command("list", "Tells what there is to choose from");
    addOption(list, "WHAT", words.kind, "", listed(listKinds()))->required();
    list.footer("Examples:\n  afterglow list scenes\n  afterglow list settings\n\n" + kExitCodes);

    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& asked) { // --help, --version
        return app.exit(asked);
    } catch (const CLI::ParseError& error) {
        refuseExtras(app); // a misspelt name is the better explanation of a missing one
        const std::string place = chosen(app) ? chosen(app)->get_name() + ": " : "";
        throw UsageError(place + error.what());
    }
    refuseExtras(app);
    return dispatch(app, words, hiddenContext);
}

int fail(int code, std::string message) {
    std::ranges::replace(message, '\n', ' ');
    std::fprintf(stderr, "afterglow: %s\n", message.c_str());
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
