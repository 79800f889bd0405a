// SPDX-License-Identifier: MIT
#include "app/commands/exchange.h"

#include "app/base/interrupt.h"
#include "app/experiment/export_frames.h"
#include "app/experiment/run_files.h"
#include "app/experiment/run_owner.h"
#include "app/experiment/runner.h"
#include "app/measure/summary.h"
#include "app/scenario/presets.h"
#include "renderer/base/error.h"
#include "renderer/base/log.h"
#include "renderer/scene/load_scene.h"
#include "renderer/scene/procedural.h"

#include <algorithm>
#include <cstdio>

namespace afterglow {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr glm::ivec2 kSize{640, 360}; // as `render` has them
constexpr int kFrames = 32;

bool isSceneName(std::string_view name) {
    return std::ranges::any_of(proceduralScenes(),
                               [&](const SceneInfo& info) { return info.name == name; });
}

bool isExperiment(std::string_view source) {
    if (source.ends_with(".json"))
        return true;
    return !isSceneName(source) &&
           std::ranges::any_of(builtInExperiments(),
                               [&](const ExperimentInfo& info) { return info.name == source; });
}

/// A name for an experiment, of the letters of a scene's.
std::string plainName(const std::string& scene) {
    std::string name = fs::path(scene).stem().string();
    for (char& c : name)
        if (!isPlainName(std::string_view(&c, 1)) && c != '.')
            c = '_';
    return isPlainName(name) ? name : "scene";
}

std::string describe(const std::vector<TimelineEvent>& events) {
    std::string text;
    for (const TimelineEvent& event : events)
        text += (text.empty() ? "" : ", ") + describe(event) + " at frame " +
                std::to_string(frameOf(event));
    return text;
}

Experiment sceneExperiment(const ExportOptions& options) {
    const Scene scene = loadScene(options.source);
    const int frames = options.frames.value_or(kFrames);
    const Timeline timeline = lightTimeline(scene, options.lights, frames);
    if (cameraIndex(scene, options.camera) != 0)
        throw UsageError("--camera " + options.camera +
                         ": frames are exported as the first "
                         "camera of the scene, " +
                         scene.cameras[0].name + ", sees them");
    Experiment experiment;
    experiment.name = plainName(options.source);
    experiment.scene = options.source;
    experiment.size = options.size.value_or(kSize);
    experiment.rate = options.rate.value_or(60.0);
    experiment.seed = options.seed.value_or(0);
    experiment.signal = options.signal.value_or(Signal::Both);
    experiment.animated = options.animate;
    experiment.variants = {variantOf(Filter::Fixed), variantOf(Filter::Svgf),
                           variantOf(Filter::Asvgf)};
    experiment.description = !timeline.events().empty() ? describe(timeline.events())
                             : options.animate          ? "the scene's own animation"
                                                        : "nothing changes";
    experiment.timeline = timeline;
    return experiment;
}

Experiment namedExperiment(const ExportOptions& options) {
    const auto refuse = [&](bool isGiven, const char* option) {
        if (isGiven)
            throw UsageError(std::string(option) + ": " + options.source +
                             " is an experiment, which says this itself");
    };
    refuse(!options.lights.empty(), "--light");
    refuse(!options.camera.empty(), "--camera");
    refuse(options.signal.has_value(), "--signal");
    refuse(options.animate, "--animate");
    Experiment experiment = loadExperiment(options.source);
    experiment.size = options.size.value_or(experiment.size);
    experiment.seed = options.seed.value_or(experiment.seed);
    if (options.frames)
        experiment.timeline = shortened(experiment.timeline, *options.frames);
    std::erase_if(experiment.variants, [](const Variant& variant) { return variant.external; });
    if (experiment.variants.empty())
        experiment.variants = {variantOf(Filter::Asvgf)};
    return experiment;
}

Experiment experimentOf(const ExportOptions& options) {
    Experiment experiment =
        isExperiment(options.source) ? namedExperiment(options) : sceneExperiment(options);
    // The export is read from elsewhere.
    if (!isSceneName(experiment.scene))
        experiment.scene = fs::absolute(experiment.scene).lexically_normal().string();
    return experiment;
}

std::vector<const AovInfo*> chosenAovs(const std::vector<std::string>& names) {
    std::vector<const AovInfo*> chosen;
    for (const std::string& name : names) {
        const AovInfo& aov = aovByName(name);
        if (!isMadeBy(aov, FilterSettings{Filter::None, {}}))
            throw UsageError("--aov " + name +
                             ": --export stands for the filter none, which does not make it");
        if (std::ranges::find(chosen, &aov) == chosen.end())
            chosen.push_back(&aov);
    }
    return chosen;
}

void requireFreeName(const std::string& name) {
    if (!isPlainName(name))
        throw UsageError("--name: expected letters, digits, \"-\", \"_\" and \".\", which is not "
                         "the first, found '" +
                         name + "'");
    const auto isFilter = [&](Filter filter) { return nameOf(filter) == name; };
    if (name == "reference" || std::ranges::any_of(allFilters(), isFilter) ||
        std::ranges::find(presets(), name, &Preset::name) != presets().end())
        throw UsageError("--name " + name + ": this is a name of our own; choose another");
}

/// The experiment of the export, with our own variants.
Experiment importedExperiment(const ImportOptions& options) {
    Experiment experiment = readExport(options.exported);
    if (options.samples)
        experiment.referenceSamples = *options.samples;
    if (options.only)
        experiment.variants.clear();
    if (!options.filters.empty()) {
        experiment.variants.clear();
        for (const std::string& filter : options.filters)
            experiment.variants.push_back(variantNamed(filter));
    }
    for (const Variant& variant : experiment.variants)
        if (variant.name == options.name)
            throw UsageError("--name " + options.name +
                             ": the experiment has a variant of this name; choose another");
    return experiment;
}

/// The external variants of a run: those that were imported into its folder before, as far as their
/// measures still hold, and the new one.
std::vector<Variant> externalVariants(const ImportOptions& options, const Experiment& experiment,
                                      const StagedRun& run, const ReferenceMaker& maker) {
    const fs::path folder = options.out;
    const std::string& name = options.name;
    const Variant added{.name = name, .filter = Filter::None, .external = true};
    std::vector<Variant> variants;
    if (const auto before = options.fresh ? std::nullopt : experimentIn(folder))
        for (const Variant& variant : parseExperiment(before->dump(), folder.string()).variants) {
            if (!variant.external || variant.name == name)
                continue;
            if (isMeasured(variant, experiment, run, maker, folder))
                variants.push_back(variant);
            else
                log(LogLevel::Warning,
                    (folder / variant.name).string() +
                        " was measured by another program, and is left out; import it again");
        }
    variants.push_back(added);
    return variants;
}

} // namespace

void runExportCommand(const ExportOptions& options, HiddenContextFactory hiddenContext) {
    const std::vector<const AovInfo*> more = chosenAovs(options.aovs);
    const Experiment experiment = experimentOf(options);
    const StagedRun run = stagedRun(experiment);
    const OutputFolder folder(options.out);
    Headless headless(options.context, hiddenContext);
    headless.resize(experiment.size);
    {
        Progress progress(experiment.frames());
        exportFrames(experiment, run, headless.renderer, headless.gl, more, options.format, folder,
                     progress);
    }
    std::printf("%s: %d frames of %dx%d for a denoiser; in %s\n", experiment.name.c_str(),
                experiment.frames(), experiment.size.x, experiment.size.y, folder.path().c_str());
}

void runImportCommand(const ImportOptions& options, HiddenContextFactory hiddenContext) {
    requireFreeName(options.name);
    Experiment experiment = importedExperiment(options);
    const StagedRun run = stagedRun(experiment);
    const ImportedFrames frames(options.name, options.frames, options.quantity, experiment.size,
                                experiment.frames());
    if (!options.fresh)
        requireFolderFor({.experiment = describe(experiment), .anyVariants = true}, options.out);
    const OutputFolder out(options.out);
    Headless headless(options.context, hiddenContext);
    headless.resize(experiment.size);
    ReferenceStore store = makeStore(options.cache, headless);
    for (const Variant& variant : externalVariants(options, experiment, run, store.maker()))
        experiment.variants.push_back(variant);
    catchInterrupts();
    {
        Progress progress(workOf(experiment, run.plan, {}));
        runExperiment(experiment, run, headless.renderer, headless.gl, store, out,
                      {.fresh = options.fresh, .imported = &frames}, progress);
    }
    Json summary = readJson(out.path() / "summary.json");
    for (const Variant& variant : experiment.variants)
        if (variant.external)
            summary["variants"][variant.name]["mean"] =
                readJson(out.path() / variant.name / "import.json").at("mean");
    std::printf("%s: %s\n%dx%d, %d frames; %s is scored by its %s\n\n%s\nreport: %s\n",
                experiment.name.c_str(), experiment.description.c_str(), experiment.size.x,
                experiment.size.y, experiment.frames(), options.name.c_str(),
                std::string(nameOf(frames.quantity())).c_str(),
                tableOf(summary, readJson(out.path() / "timing.json")).c_str(),
                (out.path() / "report.html").c_str());
}

} // namespace afterglow
