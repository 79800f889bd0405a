// SPDX-License-Identifier: MIT
#include "app/commands/experiment.h"

#include "app/base/interrupt.h"
#include "app/commands/arguments.h"
#include "app/experiment/run_files.h"
#include "app/experiment/run_owner.h"
#include "app/measure/summary.h"
#include "app/report/report.h"
#include "app/scenario/presets.h"
#include "renderer/base/error.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace afterglow {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr glm::ivec2 kQuickSize{96, 54};
constexpr int kQuickSamples = 8; // times fewer

/// "asvgf", or with settings of its own: "asvgf:alpha=0.1:lambdaFetch=nearest".
Variant variantFrom(const std::string& text) {
    std::size_t end = std::min(text.find(':'), text.size());
    Variant variant = variantNamed(text.substr(0, end));
    while (end < text.size()) {
        const std::size_t start = end + 1;
        end = std::min(text.find(':', start), text.size());
        const auto [key, value] = parseAssignment("--filter", text.substr(start, end - start));
        variant.changes.emplace_back(key, value);
        variant.name += "-" + key + "-" + value;
    }
    return variant;
}

void changeVariants(Experiment& experiment, const ExperimentOptions& options) {
    if (!options.filters.empty()) {
        experiment.variants.clear();
        for (const std::string& name : options.filters)
            experiment.variants.push_back(variantFrom(name));
    }
    for (Variant& variant : experiment.variants) {
        variant.changes.insert(variant.changes.end(), options.settings.begin(),
                               options.settings.end());
        settingsOf(variant, experiment.signal); // says what is wrong before anything is made
    }
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
    changeVariants(experiment, options);
    return experiment;
}

std::vector<Experiment> chosen(const ExperimentOptions& options) {
    std::vector<std::string> names;
    for (const std::string& name : options.experiments) {
        if (name != "all") {
            names.push_back(name);
            continue;
        }
        for (const ExperimentInfo& info : builtInExperiments())
            names.push_back(info.name);
    }
    std::vector<Experiment> experiments;
    for (const std::string& name : names) {
        experiments.push_back(changed(loadExperiment(name), options));
        const auto same =
            std::ranges::find(experiments, experiments.back().name, &Experiment::name);
        if (&*same != &experiments.back())
            throw UsageError("the experiment " + same->name + " was asked for twice");
    }
    return experiments;
}

void printRun(const Experiment& experiment, const fs::path& folder) {
    const Json account = readJson(folder / "experiment.json");
    std::printf(
        "%s: %s\n%s, %dx%d, %d frames, on %s\n\n%s\n", experiment.name.c_str(),
        experiment.description.c_str(), experiment.scene.c_str(), experiment.size.x,
        experiment.size.y, experiment.frames(),
        account.at("gl").at("renderer").get<std::string>().c_str(),
        tableOf(readJson(folder / "summary.json"), readJson(folder / "timing.json")).c_str());
    double residual = 0.0;
    for (const Json& reference : account.at("references"))
        residual = std::max(residual, reference.at("residual_rmse").get<double>());
    std::printf("references: %zu, %d samples a pixel, residual RMSE at most %.5f\n"
                "contact sheet: %s\n\n",
                account.at("references").size(), experiment.referenceSamples, residual,
                (folder / "contact_sheet.png").c_str());
}

void runAll(const std::vector<Experiment>& experiments, const ExperimentOptions& options,
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
    ReferenceStore store = makeStore(options.cache, headless);
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
        std::printf("part %d of %d: %s\n", options.run.part.index, options.run.part.count,
                    options.out.c_str());
        return;
    }
    tellSoftwareRenderer(headless.gl);
    for (const Experiment& experiment : experiments)
        printRun(experiment, folderOf(experiment));
    if (isSuite)
        writeSuite(out);
    std::printf("report: %s\n", (out.path() / "report.html").c_str());
}

} // namespace

ReferenceStore makeStore(const CacheOptions& options, const Headless& headless) {
    ReferenceMaker maker(headless.shaders, headless.gl);
    if (!options.use)
        return ReferenceStore(std::move(maker));
    if (options.folder)
        return ReferenceStore(std::move(maker), ReferenceCache(*options.folder));
    return ReferenceStore::withDefaultCache(std::move(maker));
}

void runExperimentCommand(const ExperimentOptions& options, HiddenContextFactory hiddenContext) {
    runAll(chosen(options), options, hiddenContext);
}

void runSweepCommand(const ExperimentOptions& options, const Sweep& sweep,
                     HiddenContextFactory hiddenContext) {
    std::vector<Experiment> experiments = chosen(options);
    for (Experiment& experiment : experiments) {
        std::vector<Variant> points;
        for (const Variant& variant : experiment.variants)
            for (const std::string& value : sweep.values) {
                Variant point = variant;
                point.name += "-" + sweep.key + "-" + value;
                point.changes.emplace_back(sweep.key, value);
                point.sweep = SweepPoint{variant.name, sweep.key, value};
                settingsOf(point, experiment.signal);
                points.push_back(std::move(point));
            }
        experiment.variants = std::move(points);
        experiment.name += "-" + sweep.key;
        experiment.description += ". With " + sweep.key + " swept";
    }
    runAll(experiments, options, hiddenContext);
}

void runMergeCommand(const std::vector<fs::path>& parts, const std::string& out, bool fresh) {
    const OutputFolder folder(out);
    mergeRuns(parts, folder, fresh);
    std::printf("report: %s\n", (folder.path() / "report.html").c_str());
}

void runReportCommand(const std::string& folder) {
    writeReport(folder);
    std::printf("report: %s\n", (fs::path(folder) / "report.html").c_str());
}

} // namespace afterglow
