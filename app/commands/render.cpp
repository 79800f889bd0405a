// SPDX-License-Identifier: MIT
#include "app/commands/render.h"

#include "app/base/output.h"
#include "app/base/progress.h"
#include "app/commands/command.h"
#include "app/measure/reference.h"
#include "renderer/base/error.h"
#include "renderer/base/json.h"
#include "renderer/base/names.h"
#include "renderer/scene/load_scene.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace afterglow {

namespace {

using Json = nlohmann::ordered_json;

/// Parses "key=off@8", "key=on@16" or "fill=0.5" (power, from frame 0 on). The event sets both `on`
/// and `power`: a part that the text leaves out is as in the scene.
LightEvent lightEventFrom(const std::string& text) {
    auto [light, value] = assignment().read(text);
    LightEvent event{.light = light, .on = true, .power = 1.0f};
    try {
        if (const auto at = value.rfind('@'); at != value.npos) {
            event.frame = wholeNumber(0, 1'000'000).read(value.substr(at + 1));
            value.erase(at);
        }
    } catch (const UsageError& error) {
        throw UsageError(fmt::format("{}: frame: {}", text, error.what()));
    }
    if (value == "off" || value == "on") {
        event.on = value == "on";
        return event;
    }
    try {
        event.power = float(number(0.0, 1e6, "").read(value));
    } catch (const UsageError&) {
        throw UsageError(fmt::format("expected NAME=on, NAME=off or NAME=POWER (0 to 1000000), "
                                     "each with @FRAME or without, found '{}'",
                                     text));
    }
    return event;
}

using Aovs = std::vector<const AovInfo*>;

Aovs aovsFrom(const std::string& text) {
    Aovs aovs;
    for (const std::string& name : partsOf(text))
        if (const AovInfo* aov = &aovByName(name); std::ranges::find(aovs, aov) == aovs.end())
            aovs.push_back(aov);
    return aovs;
}

/// The command render: writes frames of a scene, or its converged image.
class Render final : public Command {
public:
    explicit Render(Options& options);
    void run(HiddenContextFactory hiddenContext) override;

private:
    void check() const;
    void renderFrames(Headless& headless, const OutputFolder& folder);
    void renderReference(Headless& headless, const OutputFolder& folder);
    FrameInput inputAt(const Scene& scene, int frame, std::span<const LightState> lights) const;
    void write(const Renderer& renderer, const GpuTexture& display, const OutputFolder& folder,
               int frame);
    Json describeRun(const Headless& headless) const;

    RenderOptions o_;
    int every_ = 1;              ///< writes frames 0, every, 2 every, ...
    bool last_ = false;          ///< writes only the last frame
    std::optional<int> samples_; ///< instead of frames: the converged image of so many a pixel
    bool exports_ = false;
    std::vector<int> written_; ///< frames
};

Render::Render(Options& options) {
    options.require("SCENE", o_.source, anyText(""),
                    "A name (afterglow list scenes), or a .gltf or .glb file; with --export also "
                    "an experiment's name or .json file");
    options.require("--out,-o", o_.out, anyText("DIR"),
                    "Folder of the results; made if it is missing");
    options.add("--filter", o_.filter, filterName(),
                "A filter or a preset; afterglow list filters, presets [asvgf]");
    o_.picture.addTo(options);
    options.add("--frames,-n", o_.frames, wholeNumber(1, kMostFrames),
                "Frames to render" + defaultText(kRenderFrames));
    options.add("--size", o_.size, imageSize(),
                "Of the picture in pixels" + defaultText(kRenderSize));
    options.add("--seed", o_.seed, seedNumber(), "Of all random numbers, 0 to 4294967295 [0]");
    o_.context.addTo(options);
    options.addEach("--light", o_.lights, Kind<LightEvent>{"NAME=STATE[@FRAME]", lightEventFrom},
                    "Sets a light to on, off or a power (1 is the scene's own) from a frame on; "
                    "again for more");
    options.add("--camera", o_.camera, anyText(), "One of the scene's cameras [the first]");
    options.addFlag("--animate", o_.animate, "Plays the scene's animation; else nothing moves");
    options.add("--rate", o_.rate, number(1e-3, 1e3, "HZ"), "Frames a second of scene time [60]");
    options.add("--aov", o_.aovs, Kind<Aovs>{"A,B,...", aovsFrom},
                "Also writes these images as floats. See: afterglow list aovs");
    options.add("--format", o_.format, oneOf("format", {"png", "exr", "pfm"}),
                "Of those images: exr or pfm. png is exr: the display picture is always PNG");
    options.add("--every", every_, wholeNumber(1, kMostFrames, "K"),
                "Writes only the frames 0, K, 2K, ...");
    options.addFlag("--last", last_, "Writes only the last frame");
    options.add("--spp", samples_, wholeNumber(1, kMostSamples),
                "With --filter none: one converged image of N samples a pixel, instead of frames");
    options.addFlag(
        "--export", exports_,
        "For another denoiser: the noisy frames (--filter none) with all it needs, as floats");
    options.need("--rate", "--animate");
    options.exclude("--last", {"--every"});
    options.exclude("--spp", {"--frames", "--every", "--last", "--animate"});
    options.exclude("--export", {"--spp", "--every", "--last", "--set"});
    options.check([this] { exports_ ? checkExport(o_) : check(); });
    options.setFooter(
        R"(Writes DIR/color_0000.png, ..., DIR/<aov>_0000.exr, ... and, last, DIR/run.json.
With --export: raw, albedo, emission, normal, depth, motion and previous_depth of every
frame and, last, DIR/export.json, for afterglow import-frames.

Examples:
  afterglow render cornell --out out/cornell
  afterglow render hall --frames 64 --light key=off@32 --aov lambda,history --out out/hall
  afterglow render cornell --filter none --spp 1024 --out out/reference
  afterglow render my.glb --size 1280x720 --animate --camera Front --last --out out/my
  afterglow render light-off --export --out out/noise)");
}

/// Throws UsageError if --spp or --aov do not go together with the other options.
void Render::check() const {
    const Settings settings = o_.settings();
    if (samples_ && settings.filter != Filter::None)
        throw UsageError("--spp makes the converged image of one moment, which no filter touches; "
                         "it needs --filter none");
    for (const LightEvent& event : o_.lights)
        if (samples_ && event.frame > 0)
            throw UsageError(fmt::format("--light {}=...@{}: --spp makes one image, so lights "
                                         "change at frame 0 only",
                                         event.light, event.frame));
    for (const AovInfo* aov : o_.aovs) {
        if (isMadeBy(*aov, settings))
            continue;
        std::vector<std::string_view> makers;
        for (Filter filter : allFilters())
            if (isMadeBy(*aov, FilterSettings{filter, settings.denoiser}))
                makers.push_back(nameOf(filter));
        throw UsageError(fmt::format(
            "--aov {}: the filter {} does not make it{}{}", aov->name, nameOf(settings.filter),
            makers.empty() ? "" : "; these do: ", fmt::join(makers, ", ")));
    }
}

void Render::run(HiddenContextFactory hiddenContext) {
    if (exports_)
        return exportForDenoiser(o_, hiddenContext);
    Scene scene = loadScene(o_.source);
    cameraIndex(scene, o_.camera); // says what is wrong before anything is made
    lightTimeline(scene, o_.lights, 1);
    const OutputFolder folder(o_.out);
    Headless headless(o_.context, hiddenContext);
    headless.resize(o_.size.value_or(kRenderSize));
    headless.renderer.setScene(std::move(scene));
    samples_ ? renderReference(headless, folder) : renderFrames(headless, folder);
    noteSoftwareRenderer(headless.gl);
}

void Render::renderFrames(Headless& headless, const OutputFolder& folder) {
    Renderer& renderer = headless.renderer;
    const Scene& scene = renderer.scene();
    const int frames = o_.frames.value_or(kRenderFrames);
    const Timeline timeline = lightTimeline(scene, o_.lights, frames);
    const Settings settings = o_.settings();
    FrameClock clock;
    renderer.timer().setEnabled(true);
    {
        Progress progress(frames);
        for (int frame = 0; frame < frames; ++frame) {
            const auto lights = timeline.lightsAt(scene, frame);
            const GpuTexture& display =
                clock.render(renderer, inputAt(scene, frame, lights), settings);
            if (last_ ? frame + 1 == frames : frame % every_ == 0)
                write(renderer, display, folder, frame);
            progress.advance(1.0, fmt::format("frame {} of {}", frame + 1, frames));
        }
    }
    Json run = describeRun(headless);
    run["timing"] = describe(clock);
    folder.writeJson("run.json", run);
    fmt::print("{}: {} frames of {}x{} with {}: {:.2f} ms a frame (median), {}; in {}\n",
               scene.name, frames, renderer.size().x, renderer.size().y, nameOf(settings.filter),
               clock.medianMilliseconds(), raysText(clock.raysPerSecond()), folder.path().string());
}

void Render::renderReference(Headless& headless, const OutputFolder& folder) {
    Renderer& renderer = headless.renderer;
    const Scene& scene = renderer.scene();
    const int samples = *samples_;
    const auto lights = lightTimeline(scene, o_.lights, 1).lightsAt(scene, 0);
    const FrameInput input = inputAt(scene, 0, lights);
    const Reference result = [&] {
        Progress progress(samples);
        return converge(renderer, input, input, o_.settings(), samples,
                        [&](int count) { progress.advance(count, "samples"); });
    }();
    const double raysPerSecond = double(result.rays) / result.milliseconds * 1000.0;
    write(renderer, renderer.targets().filters[0].display, folder, 0);
    Json run = describeRun(headless);
    run["samples"] = samples;
    run["residual_rmse"] = result.residual;
    run["timing"] = {{"total_ms", result.milliseconds},
                     {"rays", result.rays},
                     {"rays_per_second", raysPerSecond}};
    folder.writeJson("run.json", run);
    fmt::print("{}: {} samples a pixel at {}x{}: {:.2f} ms a sample, {}; in {}\n", scene.name,
               samples, renderer.size().x, renderer.size().y, result.milliseconds / samples,
               raysText(raysPerSecond), folder.path().string());
}

FrameInput Render::inputAt(const Scene& scene, int frame,
                           std::span<const LightState> lights) const {
    const double seconds = o_.animate ? frame / o_.rate.value_or(kRenderRate) : 0.0;
    return {.camera = cameraAt(scene, poseAt(scene, seconds), cameraIndex(scene, o_.camera)),
            .seconds = seconds,
            .frame = std::uint32_t(frame),
            .seed = o_.seed.value_or(0),
            .lights = lights};
}

/// Writes what was asked for of the frame that the renderer has just made.
void Render::write(const Renderer& renderer, const GpuTexture& display, const OutputFolder& folder,
                   int frame) {
    folder.writePng(frameStem("color", frame) + ".png", display.read<glm::u8vec4>());
    for (const AovInfo* aov : o_.aovs)
        writeAov(folder, o_.floatFormat(), renderer, *aov, frame);
    written_.push_back(frame);
}

Json Render::describeRun(const Headless& headless) const {
    Json lights = Json::array(), aovs = Json::array();
    for (const LightEvent& event : o_.lights)
        lights.push_back({{"frame", event.frame},
                          {"light", event.light},
                          {"on", *event.on},
                          {"power", *event.power}});
    for (const AovInfo* aov : o_.aovs)
        aovs.push_back(aov->name);
    const Settings settings = o_.settings();
    const Scene& scene = headless.renderer.scene();
    const glm::ivec2 size = headless.renderer.size();
    return {{"program", "afterglow"},
            {"version", version()},
            {"command", "render"},
            {"scene", describe(scene, headless.renderer.sceneStats())},
            {"camera", scene.cameras.at(cameraIndex(scene, o_.camera)).name},
            {"gl", describe(headless.gl)},
            {"size", {size.x, size.y}},
            {"frames", samples_ ? 1 : o_.frames.value_or(kRenderFrames)},
            {"rate", o_.rate.value_or(kRenderRate)},
            {"animate", o_.animate},
            {"seed", o_.seed.value_or(0)},
            {"filter", nameOf(settings.filter)},
            {"signal", nameOf(Signal(settings.lighting.signal))},
            {"light_changes", lights},
            {"settings", parseJson(jsonText(toJson(settings)))},
            {"output", {{"frames", written_}, {"aovs", aovs}, {"aov_format", o_.floatFormat()}}}};
}

} // namespace

std::size_t cameraIndex(const Scene& scene, std::string_view name) {
    if (name.empty())
        return 0;
    std::vector<std::string_view> known;
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        if (scene.cameras[i].name == name)
            return i;
        known.push_back(scene.cameras[i].name);
    }
    throw UsageError(scene.name + ": " + unknownName("camera", name, known));
}

const CommandRow kRenderCommand{"render", "Renders frames into files", make<Render>};

} // namespace afterglow
