// SPDX-License-Identifier: MIT
#include "app/commands/experiment_run.h"

#include "app/base/interrupt.h"
#include "app/experiment/run_files.h"
#include "app/experiment/run_owner.h"
#include "app/measure/summary.h"
#include "renderer/base/error.h"

#include <algorithm>

#include <fmt/format.h>

namespace afterglow {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr glm::ivec2 kQuickSize{96, 54};
constexpr int kQuickSamples = 8; // times fewer
constexpr int kMostParts = 100'000;

/// "3/8"
Part partFrom(const std::string& text) {
    const std::size_t slash = text.find('/');
    if (slash == text.npos)
        throw UsageError("'" + text + "' is not a part; the third of eight is 3/8");
    const int count = wholeNumber(1, kMostParts).read(text.substr(slash + 1));
    return {.index = wholeNumber(1, count).read(text.substr(0, slash)), .count = count};
}

Experiment changed(Experiment experiment, const ExperimentOptions& options) {
    if (options.size || options.quick)
        experiment.size = options.size.value_or(kQuickSize);
    if (options.samples || options.quick)
        experiment.referenceSamples =
            options.samples.value_or(std::max(8, experiment.referenceSamples / kQuickSamples));
    if (options.frames)
        experiment.timeline = shortened(experiment.timeline, *options.frames);
    experiment.signal = options.signal.value_or(experiment.signal);
    if (!options.variants.empty())
        experiment.variants = options.variants;
    for (Variant& variant : experiment.variants) {
        variant.changes.insert(variant.changes.end(), options.settings.begin(),
                               options.settings.end());
        settingsOf(variant, experiment.signal); // says what is wrong before anything is made
    }
    return experiment;
}

void print(const Experiment& experiment, const fs::path& folder) {
    const Json account = readJson(folder / "experiment.json");
    fmt::print("{}: {}\n{}, {}x{}, {} frames, on {}\n\n{}\n", experiment.name,
               experiment.description, experiment.scene, experiment.size.x, experiment.size.y,
               experiment.frames(), account.at("gl").at("renderer").get<std::string>(),
               tableOf(readJson(folder / "summary.json"), readJson(folder / "timing.json")));
    double residual = 0.0;
    for (const Json& reference : account.at("references"))
        residual = std::max(residual, reference.at("residual_rmse").get<double>());
    fmt::print("references: {}, {} samples a pixel, residual RMSE at most {:.5f}\n"
               "contact sheet: {}\n\n",
               account.at("references").size(), experiment.referenceSamples, residual,
               (folder / "contact_sheet.png").string());
}

} // namespace

void ExperimentOptions::addTo(Options& options, const std::string& helpOfExperiments) {
    options.addEach("EXPERIMENT", experiments, anyText(""), helpOfExperiments);
    options.require("--out,-o", out, anyText("DIR"),
                    "Folder of the results; made if it is missing");
    options.add("--filter", variants, listOf(filterWithSettings()),
                "Instead of the experiment's own variants: filters or presets, each also with "
                "settings of its own, A:KEY=VALUE");
    options.addEach("--set", settings, setting(), "Of every variant; afterglow list settings");
    options.add("--size", size, imageSize(), "Instead of the experiment's own");
    options.add("--frames,-n", frames, wholeNumber(1, kMostFrames),
                "Instead of the experiment's own; later events do not happen");
    options.add("--signal", signal, signalName(),
                "shadows, ao, both or separate, instead of the experiment's own");
    options.add("--spp", samples, wholeNumber(1, kMostSamples),
                "Samples a pixel of each reference, likewise");
    options.addFlag("--quick", quick, "96x54 pixels and an eighth of the reference samples");
    options.addFlag("--fresh", run.fresh, "Do again, and replace, what DIR holds");
    options.add("--part", run.part, Kind<Part>{"K/N", partFrom},
                "Only the K-th of N shares of the frames; see afterglow merge");
    cache.addTo(options);
    context.addTo(options);
}

std::vector<Experiment> ExperimentOptions::chosen() const {
    std::vector<std::string> names;
    for (const std::string& name : experiments) {
        if (name != "all") {
            names.push_back(name);
            continue;
        }
        for (const ExperimentInfo& info : builtInExperiments())
            names.push_back(info.name);
    }
    std::vector<Experiment> result;
    for (const std::string& name : names) {
        Experiment experiment = changed(loadExperiment(name), *this);
        if (std::ranges::find(result, experiment.name, &Experiment::name) != result.end())
            throw UsageError("the experiment " + experiment.name + " was asked for twice");
        result.push_back(std::move(experiment));
    }
    return result;
}

void runExperiments(const std::vector<Experiment>& experiments, const ExperimentOptions& options,
                    HiddenContextFactory hiddenContext) {
    std::vector<StagedRun> runs;
    double work = 0.0;
    for (const Experiment& experiment : experiments) {
        runs.push_back(stagedRun(experiment));
        work += workOf(experiment, runs.back().plan, options.run.part);
    }
    const bool isSuite = experiments.size() > 1;
    const auto folderOf = [&](const Experiment& experiment) {
        return isSuite ? fs::path(options.out) / experiment.name : fs::path(options.out);
    };
    if (!options.run.fresh) {
        if (isSuite)
            requireFolderForRuns(options.out);
        for (const Experiment& experiment : experiments)
            requireFolderFor({describe(experiment), options.run.part}, folderOf(experiment));
    }
    const OutputFolder out(options.out);
    Headless headless(options.context, hiddenContext);
    ReferenceStore store = options.cache.store(headless);
    if (isSuite)
        takeFolderForRuns(out, options.run.fresh);
    catchInterrupts();
    {
        Progress progress(work);
        for (std::size_t i = 0; i < experiments.size(); ++i) {
            headless.resize(experiments[i].size);
            runExperiment(experiments[i], runs[i], headless.renderer, headless.gl, store,
                          OutputFolder(folderOf(experiments[i])), options.run, progress);
        }
    }
    if (!options.run.part.isWhole()) {
        fmt::print("part {} of {}: {}\n", options.run.part.index, options.run.part.count,
                   options.out);
        return;
    }
    noteSoftwareRenderer(headless.gl);
    for (const Experiment& experiment : experiments)
        print(experiment, folderOf(experiment));
    if (isSuite)
        writeSuite(out);
    fmt::print("report: {}\n", (out.path() / "report.html").string());
}

} // namespace afterglow
