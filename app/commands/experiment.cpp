// SPDX-License-Identifier: MIT
// The commands experiment and sweep.

#include "app/base/progress.h"
#include "app/commands/command.h"
#include "app/commands/shared_options.h"
#include "app/experiment/run_files.h"
#include "app/experiment/run_owner.h"
#include "app/experiment/runner.h"
#include "app/measure/summary.h"
#include "app/report/report.h"
#include "renderer/base/error.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace afterglow {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr glm::ivec2 kQuickSize{96, 54};
constexpr int kQuickSamples = 8; // times fewer
constexpr int kMostParts = 100'000;

/// The options that `afterglow experiment` and `afterglow sweep` share.
struct ExperimentOptions {
    std::vector<std::string> experiments; ///< names of built-in ones, or files; "all": all built in
    std::string out;
    // Instead of what the experiments say themselves:
    std::vector<Variant> variants;
    std::vector<Assignment> settings; ///< of every variant
    std::optional<glm::ivec2> size;
    std::optional<int> frames; ///< events at later frames do not happen
    std::optional<Signal> signal;
    std::optional<int> samples; ///< of each reference, per pixel
    bool quick = false;         ///< small pictures and rough references, where nothing else is said
    RunOptions run;
    CacheGroup cache;
    ContextGroup context;

    void addTo(Options& options, const std::string& helpOfExperiments);
    /// Returns the experiments with what is asked for instead.
    std::vector<Experiment> chosen() const;
};

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
        // Says what is wrong before anything is made.
        requireMeasurable(settingsOf(variant, experiment.signal));
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
    options.add("--signal", signal, signalName(), "As for render, instead of the experiment's own");
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

/// Runs them, into the folder itself if there is only one and else into a folder each, and prints
/// tables.
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
        writeReport(out.path());
    fmt::print("report: {}\n", (out.path() / "report.html").string());
}

/// The command experiment: measures every variant of experiments.
class ExperimentCommand final : public Command {
public:
    explicit ExperimentCommand(Options& options) {
        o_.addTo(options, "Names (afterglow list experiments), .json files, or all");
        options.setFooter(
            R"(Runs every variant over the same frames with the same seed, and compares each frame with
a converged picture of the same moment. Writes DIR/report.html, DIR/contact_sheet.png,
DIR/summary.json, DIR/metrics.csv, DIR/experiment.json and every frame; with more than one
experiment, a folder for each. What an interrupted run has done is not done again; a
folder of another run is refused.

t50, t90, t99: frames from the event (its own is 0) until the response stays above that
part of the change. ghost frames: the area above the response curve. lag: the same between
the filter's own settled values. rmse, flicker, noise: of linear color, over the pixels
that show a surface.

Examples:
  afterglow experiment light-off --out out/light-off
  afterglow experiment all --size 320x180 --out out/suite
  afterglow experiment my.json --filter svgf,asvgf --set alpha=0.1 --out out/my
  afterglow experiment my.json --part 2/4 --out out/part2)");
    }

    void run(HiddenContextFactory hiddenContext) override {
        runExperiments(o_.chosen(), o_, hiddenContext);
    }

private:
    ExperimentOptions o_;
};

/// Parses "alpha=0.1,0.2" into the setting and its values.
std::vector<Assignment> pointsFrom(const std::string& text) {
    const auto [key, values] = assignment().read(text);
    std::vector<Assignment> points;
    for (const std::string& value : partsOf(values))
        points.push_back(setting().read(key + "=" + value));
    return points;
}

/// The command sweep: measures every variant at each value of a setting.
class Sweep final : public Command {
public:
    explicit Sweep(Options& options) {
        options.require("--over", over_, Kind<std::vector<Assignment>>{"KEY=A,B,...", pointsFrom},
                        "The setting and its values");
        o_.addTo(options, "Names (afterglow list experiments) or .json files");
        options.setFooter(
            R"(Runs every variant with every value, and draws settled noise against lag in
DIR/report.html, a curve for each variant.

Examples:
  afterglow sweep fill-light --over alpha=0.02,0.05,0.1,0.2,0.4 --out out/alpha
  afterglow sweep fill-light --over gradientIterations=1,3,5 --filter asvgf --out out/iterations)");
    }

    void run(HiddenContextFactory hiddenContext) override {
        std::vector<Experiment> experiments = o_.chosen();
        for (Experiment& experiment : experiments)
            spread(experiment);
        runExperiments(experiments, o_, hiddenContext);
    }

private:
    void spread(Experiment& experiment) const {
        std::vector<Variant> points;
        for (const Variant& variant : experiment.variants)
            for (const Assignment& change : over_) {
                const auto& [key, value] = change;
                Variant point = variant;
                point.name += "-" + key + "-" + value;
                point.changes.push_back(change);
                point.sweep = SweepPoint{variant.name, key, value};
                // Says what is wrong before anything is made.
                requireMeasurable(settingsOf(point, experiment.signal));
                points.push_back(std::move(point));
            }
        experiment.variants = std::move(points);
        experiment.name += "-" + over_[0].first;
        experiment.description += ". With " + over_[0].first + " swept";
    }

    ExperimentOptions o_;
    std::vector<Assignment> over_; ///< the setting with each of its values
};

} // namespace

const CommandRow kExperimentCommand{"experiment",
                                    "Compares filters while something changes, and measures them",
                                    make<ExperimentCommand>};
const CommandRow kSweepCommand{
    "sweep", "Runs an experiment for each value of a setting: noise against lag", make<Sweep>};

} // namespace afterglow
