// SPDX-License-Identifier: MIT
// afterglow render --export

#include "app/commands/render.h"
#include "app/experiment/export_frames.h"
#include "app/scenario/experiment.h"
#include "renderer/base/error.h"
#include "renderer/scene/load_scene.h"
#include "renderer/scene/procedural.h"

#include <algorithm>

#include <fmt/format.h>

namespace afterglow {

namespace {

namespace fs = std::filesystem;

bool isSceneName(std::string_view name) {
    return std::ranges::any_of(proceduralScenes(),
                               [&](const SceneInfo& scene) { return scene.name == name; });
}

bool isExperiment(const std::string& source) {
    const auto known = builtInExperiments();
    return source.ends_with(".json") ||
           (!isSceneName(source) &&
            std::ranges::find(known, source, &ExperimentInfo::name) != known.end());
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
    std::vector<std::string> texts;
    for (const TimelineEvent& event : events)
        texts.push_back(fmt::format("{} at frame {}", describe(event), frameOf(event)));
    return fmt::format("{}", fmt::join(texts, ", "));
}

Experiment sceneExperiment(const RenderOptions& options) {
    const Scene scene = loadScene(options.source);
    if (cameraIndex(scene, options.camera) != 0)
        throw UsageError(fmt::format("--camera {}: frames are exported as the first camera of the "
                                     "scene, {}, sees them",
                                     options.camera, scene.cameras[0].name));
    Experiment experiment;
    experiment.name = plainName(options.source);
    experiment.scene = options.source;
    experiment.size = options.size.value_or(kRenderSize);
    experiment.rate = options.rate.value_or(kRenderRate);
    experiment.seed = options.seed.value_or(0);
    experiment.signal = options.picture.signal.value_or(Signal::Both);
    experiment.animated = options.animate;
    experiment.variants = {variantOf(Filter::Fixed), variantOf(Filter::Svgf),
                           variantOf(Filter::Asvgf)};
    experiment.timeline =
        lightTimeline(scene, options.lights, options.frames.value_or(kRenderFrames));
    experiment.description = !experiment.timeline.events().empty()
                                 ? describe(experiment.timeline.events())
                             : options.animate ? "the scene's own animation"
                                               : "nothing changes";
    return experiment;
}

Experiment namedExperiment(const RenderOptions& options) {
    const auto refuse = [&](bool isGiven, const char* option) {
        if (isGiven)
            throw UsageError(fmt::format("{}: {} is an experiment, which says this itself", option,
                                         options.source));
    };
    refuse(!options.lights.empty(), "--light");
    refuse(!options.camera.empty(), "--camera");
    refuse(options.picture.signal.has_value(), "--signal");
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

} // namespace

void checkExport(const RenderOptions& options) {
    if (options.filter && settingsOf(*options.filter, Signal::Both).filter != Filter::None)
        throw UsageError(
            fmt::format("--filter {}: --export stands for --filter none", options.filter->name));
    for (const AovInfo* aov : options.aovs)
        if (!isMadeBy(*aov, FilterSettings{Filter::None, {}}))
            throw UsageError(
                fmt::format("--aov {}: --export stands for the filter none, which does not make it",
                            aov->name));
}

void exportForDenoiser(const RenderOptions& options, HiddenContextFactory hiddenContext) {
    Experiment experiment =
        isExperiment(options.source) ? namedExperiment(options) : sceneExperiment(options);
    // The export is read from elsewhere.
    if (!isSceneName(experiment.scene))
        experiment.scene = fs::absolute(experiment.scene).lexically_normal().string();
    const StagedRun run = stagedRun(experiment);
    const OutputFolder folder(options.out);
    Headless headless(options.context, hiddenContext);
    headless.resize(experiment.size);
    {
        Progress progress(experiment.frames());
        exportFrames(experiment, run, headless.renderer, headless.gl, options.aovs,
                     options.floatFormat(), folder, progress);
    }
    fmt::print("{}: {} frames of {}x{} for a denoiser; in {}\n", experiment.name,
               experiment.frames(), experiment.size.x, experiment.size.y, folder.path().string());
}

} // namespace afterglow
