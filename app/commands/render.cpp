// SPDX-License-Identifier: MIT
#include "app/commands/render.h"

#include "app/base/aov_files.h"
#include "app/base/output.h"
#include "app/base/progress.h"
#include "app/measure/reference.h"
#include "renderer/base/error.h"
#include "renderer/pipeline/aov.h"
#include "renderer/scene/load_scene.h"

#include <algorithm>
#include <cstdio>

namespace afterglow {

namespace {

using Json = nlohmann::ordered_json;

std::vector<const AovInfo*> chosenAovs(const RenderOptions& options) {
    std::vector<const AovInfo*> chosen;
    for (const std::string& name : options.aovs) {
        const AovInfo& aov = aovByName(name);
        if (!isMadeBy(aov, options.settings)) {
            std::string makers;
            for (Filter filter : allFilters())
                if (isMadeBy(aov, FilterSettings{filter, options.settings.denoiser}))
                    makers += (makers.empty() ? "" : ", ") + std::string(nameOf(filter));
            throw UsageError("--aov " + name + ": the filter " +
                             std::string(nameOf(options.settings.filter)) + " does not make it" +
                             (makers.empty() ? "" : "; these do: " + makers));
        }
        if (std::ranges::find(chosen, &aov) == chosen.end())
            chosen.push_back(&aov);
    }
    return chosen;
}

FrameInput inputAt(const RenderOptions& options, const Scene& scene, std::size_t camera, int frame,
                   std::span<const LightState> lights) {
    const double seconds = options.animate ? frame / options.rate : 0.0;
    return {.camera = cameraAt(scene, poseAt(scene, seconds), camera),
            .seconds = seconds,
            .frame = std::uint32_t(frame),
            .seed = options.seed,
            .lights = lights};
}

/// Writes what was asked for of the frame that the renderer has just made.
class FrameWriter {
public:
    FrameWriter(const RenderOptions& options, const OutputFolder& folder)
        : aovs_(chosenAovs(options)), format_(options.format == "pfm" ? "pfm" : "exr"),
          folder_(folder) {}

    void write(const Renderer& renderer, const GpuTexture& display, int frame) {
        folder_.writePng(frameStem("color", frame) + ".png", display.read<glm::u8vec4>());
        for (const AovInfo* aov : aovs_)
            writeAov(folder_, format_, renderer, *aov, frame);
        frames_.push_back(frame);
    }

    Json describe() const {
        Json names = Json::array();
        for (const AovInfo* aov : aovs_)
            names.push_back(aov->name);
        return {{"frames", frames_}, {"aovs", names}, {"aov_format", format_}};
    }

private:
    std::vector<const AovInfo*> aovs_;
    std::string format_;
    const OutputFolder& folder_;
    std::vector<int> frames_;
};

Json describeRun(const RenderOptions& options, const Headless& headless, std::size_t camera) {
    Json lights = Json::array();
    for (const LightEvent& event : options.lights)
        lights.push_back({{"frame", event.frame},
                          {"light", event.light},
                          {"on", *event.on},
                          {"power", *event.power}});
    const Scene& scene = headless.renderer.scene();
    return {{"program", "afterglow"},
            {"version", version()},
            {"command", "render"},
            {"scene", describe(scene, headless.renderer.sceneStats())},
            {"camera", scene.cameras.at(camera).name},
            {"gl", describe(headless.gl)},
            {"size", {options.size.x, options.size.y}},
            {"frames", options.samples ? 1 : options.frames},
            {"rate", options.rate},
            {"animate", options.animate},
            {"seed", options.seed},
            {"filter", nameOf(options.settings.filter)},
            {"signal", nameOf(Signal(options.settings.lighting.signal))},
            {"light_changes", lights},
            {"settings", Json::parse(toJson(options.settings).dump())}};
}

void renderFrames(const RenderOptions& options, Headless& headless, std::size_t camera,
                  const OutputFolder& folder) {
    Renderer& renderer = headless.renderer;
    const Scene& scene = renderer.scene();
    const Timeline timeline = lightTimeline(scene, options.lights, options.frames);
    FrameWriter writer(options, folder);
    FrameClock clock;
    renderer.timer().setEnabled(true);
    {
        Progress progress(options.frames);
        for (int frame = 0; frame < options.frames; ++frame) {
            const auto lights = timeline.lightsAt(scene, frame);
            const GpuTexture& display = clock.render(
                renderer, inputAt(options, scene, camera, frame, lights), options.settings);
            const bool isLast = frame + 1 == options.frames;
            if (options.lastOnly ? isLast : frame % options.every == 0)
                writer.write(renderer, display, frame);
            progress.advance(1.0, "frame " + std::to_string(frame + 1) + " of " +
                                      std::to_string(options.frames));
        }
    }
    Json run = describeRun(options, headless, camera);
    run["output"] = writer.describe();
    run["timing"] = describe(clock);
    folder.writeJson("run.json", run);
    std::printf("%s: %d frames of %dx%d with %s: %.2f ms a frame (median), %s; in %s\n",
                scene.name.c_str(), options.frames, options.size.x, options.size.y,
                std::string(nameOf(options.settings.filter)).c_str(), clock.medianMilliseconds(),
                raysText(clock.raysPerSecond()).c_str(), folder.path().c_str());
}

void renderReference(const RenderOptions& options, Headless& headless, std::size_t camera,
                     const OutputFolder& folder) {
    Renderer& renderer = headless.renderer;
    const Scene& scene = renderer.scene();
    const int samples = *options.samples;
    FrameWriter writer(options, folder);
    const auto lights = lightTimeline(scene, options.lights, 1).lightsAt(scene, 0);
    const FrameInput input = inputAt(options, scene, camera, 0, lights);
    const Reference result = [&] {
        Progress progress(samples);
        return converge(renderer, input, input, options.settings, samples,
                        [&](int count) { progress.advance(count, "samples"); });
    }();
    writer.write(renderer, renderer.targets().filters[0].display, 0);
    Json run = describeRun(options, headless, camera);
    run["samples"] = samples;
    run["residual_rmse"] = result.residual;
    run["output"] = writer.describe();
    run["timing"] = {{"total_ms", result.milliseconds},
                     {"rays", result.rays},
                     {"rays_per_second", double(result.rays) / result.milliseconds * 1000.0}};
    folder.writeJson("run.json", run);
    std::printf("%s: %d samples a pixel at %dx%d: %.2f ms a sample, %s; in %s\n",
                scene.name.c_str(), samples, options.size.x, options.size.y,
                result.milliseconds / samples,
                raysText(double(result.rays) / result.milliseconds * 1000.0).c_str(),
                folder.path().c_str());
}

} // namespace

void runRender(const RenderOptions& options, HiddenContextFactory hiddenContext) {
    // What is wrong with the words themselves is said before any work is done.
    chosenAovs(options);
    if (options.samples && options.settings.filter != Filter::None)
        throw UsageError(
            "--spp makes the converged image of one moment, which no filter touches; it "
            "needs --filter none");
    for (const LightEvent& event : options.lights)
        if (options.samples && event.frame > 0)
            throw UsageError("--light " + event.light + "=...@" + std::to_string(event.frame) +
                             ": --spp makes one image, so lights change at frame 0 only");
    Scene scene = loadScene(options.scene);
    const std::size_t camera = cameraIndex(scene, options.camera);
    lightTimeline(scene, options.lights, options.frames);
    const OutputFolder folder(options.out);

    Headless headless(options.context, hiddenContext);
    headless.resize(options.size);
    headless.renderer.setScene(std::move(scene));
    if (options.samples)
        renderReference(options, headless, camera, folder);
    else
        renderFrames(options, headless, camera, folder);
    tellSoftwareRenderer(headless.gl);
}

} // namespace afterglow
