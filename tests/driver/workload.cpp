// SPDX-License-Identifier: MIT
#include "tests/driver/workload.h"

#include "renderer/base/hash.h"
#include "renderer/filters/svgf_filter.h"
#include "renderer/passes/debug_view_pass.h"
#include "renderer/passes/difference_pass.h"
#include "renderer/passes/probe_pass.h"
#include "renderer/passes/reason_pass.h"
#include "renderer/pipeline/renderer.h"
#include "renderer/scene/procedural.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/sequence.h"
#include "tests/support/source_dir.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace afterglow::test {

namespace {

constexpr glm::ivec2 kSize{61, 37}, kOtherSize{19, 26};
constexpr int kFrames = 3;

/// A renderer whose images are noted under the name of what is being rendered.
class Desk {
public:
    explicit Desk(ShaderLibrary& shaders) : renderer(shaders, glInfo(testContext())) {
        renderer.setScene(makeProceduralScene("moving"));
        renderer.resize(kOtherSize);
        camera_ = cameraAt(renderer.scene(), poseAt(renderer.scene(), 0.0));
        lights_.resize(renderer.scene().lights.size());
    }

    Renderer renderer;
    std::string chapter;
    Outputs outputs;

    FrameInput input(std::uint32_t frame) {
        Camera swayed = camera_;
        swayed.position.x += 0.02f * std::sin(0.9f * float(frame));
        lights_[0].on = frame % 4 != 2;
        return {.camera = swayed,
                .seconds = double(frame) / 60.0,
                .frame = frame,
                .seed = 3,
                .lights = lights_};
    }
    void render(std::uint32_t frame, const FrameSettings& settings,
                const std::vector<FilterRun>& runs) {
        renderer.render(input(frame), settings, runs);
        for (const FilterRun& run : runs)
            noteFilter(run, frame);
        const FrameStats stats = renderer.readStats();
        note("stats " + std::to_string(frame), std::to_string(stats.rays) + " " +
                                                   std::to_string(stats.gradientSamples) + " " +
                                                   std::to_string(stats.invalidValues));
    }
    void note(const std::string& name, const std::string& value) {
        outputs.emplace_back(chapter + ": " + name, value);
    }
    void note(const std::string& name, const GpuTexture& texture) {
        Hash hash;
        const auto add = [&](const auto& image) {
            const auto bytes = std::as_bytes(image.pixels());
            hash.addList(
                std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
        };
        switch (texture.format()) {
        case PixelFormat::R32F: add(texture.read<float>()); break;
        case PixelFormat::RG32F: add(texture.read<glm::vec2>()); break;
        case PixelFormat::R32UI: add(texture.read<std::uint32_t>()); break;
        case PixelFormat::RG32UI: add(texture.read<glm::uvec2>()); break;
        case PixelFormat::RGBA32UI: add(texture.read<glm::uvec4>()); break;
        case PixelFormat::RGBA8: add(texture.read<glm::u8vec4>()); break;
        default: add(texture.read<glm::vec4>()); break;
        }
        note(name, hash.hex());
    }

private:
    void noteFilter(const FilterRun& run, std::uint32_t frame) {
        const std::string at = " " + std::to_string(run.state) + " of " + std::to_string(frame);
        const RenderTargets& t = renderer.targets();
        for (const GpuTexture* image : t.surfaces.all())
            note(image->label() + at, *image);
        note("seeds" + at, t.seeds.current());
        if (needsOf(run.settings).lambda)
            note("samples" + at, t.samples);
        for (std::size_t signal = 0; signal < renderer.signals().size(); ++signal) {
            const std::string of = at + " signal " + std::to_string(signal);
            note("raw" + of, t.signals[signal].raw.current());
            note("filtered" + of, renderer.filteredSignal(run.state, signal));
            for (const FilterAov& aov : familyOf(run.settings.filter).aovs)
                if (const auto image = renderer.filterImage(aov.info.name, run.state, signal);
                    image.texture)
                    note(std::string(aov.info.name) + of, *image.texture);
        }
        note("display" + at, renderer.display(run.state));
        for (const GpuTexture* kept :
             {&t.filters[run.state].resolved.current(), &t.exposure.current()})
            if (kept->size().x != 0)
                note(kept->label() + at, *kept);
    }

    Camera camera_;
    std::vector<LightState> lights_;
};

void renderFilterAt(Desk& desk, const Settings& settings) {
    const std::vector<FilterRun> run{{0, settings}};
    desk.renderer.resize(kOtherSize);
    desk.render(0, settings, run);
    desk.renderer.resize(kSize);
    for (int frame = 1; frame <= kFrames; ++frame)
        desk.render(std::uint32_t(frame), settings, run);
}

Settings withPlacement(Filter filter, SamplePlacement placement) {
    Settings settings = settingsOf(filter);
    settings.lighting.gradientSamples = int(placement);
    return settings;
}

void renderTogether(Desk& desk, SamplePlacement placement) {
    desk.chapter = placement == SamplePlacement::Merged ? "together" : "together, extra samples";
    desk.renderer.resize(kOtherSize);
    desk.renderer.resize(kSize);
    const Settings shared = withPlacement(Filter::Asvgf, placement);
    std::vector<FilterRun> runs{{3, shared}, {1, settingsOf(Filter::Fixed)}};
    desk.render(0, shared, runs);
    runs.push_back({0, settingsOf(Filter::Percentile)});
    desk.render(1, shared, runs);
    const HistoryCheckpoint kept = desk.renderer.checkpoint();
    desk.render(2, shared, runs);
    desk.renderer.restore(kept);
    desk.chapter += ", again";
    desk.render(2, shared, runs);
}

void renderReferences(Desk& desk) {
    const Settings settings = settingsOf(Filter::None);
    const auto converge = [&](const char* name, std::uint32_t seen, std::uint32_t world) {
        desk.chapter = name;
        desk.renderer.beginReference(desk.input(seen), desk.input(world), settings);
        desk.renderer.addReferenceSamples(2);
        desk.note("display", desk.renderer.finishReference());
        desk.note("mean", desk.renderer.filteredSignal());
    };
    converge("reference", 5, 5);
    converge("reference of two moments", 5, 4);
    desk.chapter = "shown reference";
    const Image<glm::vec4> gray(kSize, glm::vec4(0.25f));
    desk.note("display", desk.renderer.showReference({&gray, 1}, settings));
}

void inspectFrame(Desk& desk, ShaderLibrary& shaders) {
    TemporalPass temporal(shaders);
    GradientPass gradient(shaders);
    for (const SamplePlacement placement : {SamplePlacement::Merged, SamplePlacement::Extra}) {
        const Settings settings = withPlacement(Filter::Asvgf, placement);
        for (const std::uint32_t frame : {7u, 8u})
            desk.render(frame, settings, {{0, settings}});
        auto [context, in, own] = desk.renderer.filterCall(0, 0);
        const SvgfPlan plan = makePlan(settings);
        for (const glm::ivec2 pixel : {glm::ivec2(0), glm::ivec2(30, 20), kSize - 1}) {
            PixelReadback readback;
            const auto found = temporal.inspect(context, svgf::temporalInputs(in, own),
                                                svgf::temporalParams(in, plan), pixel, readback);
            const auto change = gradient.inspect(context, svgf::gradientInputs(in), plan.gradient,
                                                 pixel / 3, readback);
            readback.finish();
            Hash hash;
            const auto add = [&](const auto& values) {
                const auto bytes = std::as_bytes(std::span(&values, 1));
                hash.addList(
                    std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
            };
            add(readback.pixel(found));
            add(readback.pixel(change));
            desk.note("inspected", hash.hex());
        }
    }
}

void lookAtFrame(Desk& desk, ShaderLibrary& shaders) {
    desk.chapter = "instruments";
    const Settings settings = settingsOf(Filter::Asvgf);
    desk.render(7, settings, {{0, settings}});
    const RenderTargets& t = desk.renderer.targets();
    const Surfaces& surfaces = t.surfaces;
    const History& raw = t.signals[0].raw;
    const GpuTexture& control = *desk.renderer.filterImage("alpha").texture;
    FrameContext context{desk.renderer.timer()};

    ProbePass probe(shaders);
    for (const glm::ivec2 size : {glm::ivec2(5, 40), kSize}) {
        probe.run(context,
                  {desk.renderer.filteredSignal(), raw.current(), surfaces.albedo, surfaces.guides,
                   control},
                  {7, 3}, size);
        const ProbeReading r = probe.read();
        Hash hash;
        for (const double value : {double(r.pixels), r.lit, r.rawLit, r.rawVariance, r.variance,
                                   r.lambda, r.alpha, r.history, r.rawLitVariance})
            hash.addList(std::to_string(value));
        desk.note("probe", hash.hex());
    }
    ReasonPass reasons(shaders);
    for (const GpuTexture* samples : {static_cast<const GpuTexture*>(nullptr), &t.samples}) {
        reasons.run(context, {control, surfaces.guides, samples});
        const ReasonCounts counts = reasons.read();
        std::string text;
        for (const std::uint32_t n : counts.history)
            text += std::to_string(n) + " ";
        for (const std::uint32_t n : counts.fates)
            text += std::to_string(n) + " ";
        desk.note("reasons", text);
    }
    GpuTexture difference("difference", PixelFormat::RGBA32F, kSize);
    DifferencePass(shaders).run(context, raw.current(), raw.previous(), difference);
    desk.note("difference", difference);
    GpuTexture view("view", PixelFormat::RGBA8, kSize);
    DebugViewPass debugView(shaders);
    debugView.run(context, surfaces.motion, view,
                  {gpu::kMapDirection, 0, 1, 0, 0.0f, 1.0f, 0.0f, 0.0f});
    desk.note("view of motion", view);
    debugView.run(context, surfaces.visibility, view,
                  {gpu::kMapNumber, 0, 1, 0, 0.0f, 1.0f, 0.0f, 0.0f});
    desk.note("view of instances", view);
    inspectFrame(desk, shaders);
}

} // namespace

Outputs renderFilter(ShaderLibrary& shaders, const Settings& settings) {
    Desk desk(shaders);
    desk.chapter = std::string(nameOf(settings.filter));
    renderFilterAt(desk, settings);
    return desk.outputs;
}

Outputs renderEverything(ShaderLibrary& shaders) {
    Desk desk(shaders);
    for (const Filter filter : allFilters()) {
        desk.chapter = std::string(nameOf(filter));
        renderFilterAt(desk, settingsOf(filter));
    }
    desk.chapter = "extra samples";
    renderFilterAt(desk, withPlacement(Filter::Asvgf, SamplePlacement::Extra));
    for (const Signal signal : {Signal::Shadows, Signal::AmbientOcclusion, Signal::Separate}) {
        desk.chapter = signal == Signal::Shadows            ? "shadows"
                       : signal == Signal::AmbientOcclusion ? "ambient occlusion"
                                                            : "signals apart";
        Settings settings = settingsOf(Filter::Asvgf, signal);
        settings.denoiser.kernel = int(Kernel::Box3x3);
        renderFilterAt(desk, settings);
    }
    for (const TaaOrder order : {TaaOrder::BeforeToneMap, TaaOrder::AfterToneMap}) {
        desk.chapter = order == TaaOrder::BeforeToneMap ? "smoothed" : "smoothed after tone map";
        Settings settings = settingsOf(Filter::Asvgf);
        settings.display.antiAliasing = int(AntiAliasing::Taa);
        settings.display.taaOrder = int(order);
        settings.display.autoExposure = 1;
        settings.display.toneMapper =
            order == TaaOrder::BeforeToneMap ? gpu::kToneAgx : gpu::kToneNeutral;
        renderFilterAt(desk, settings);
    }
    renderTogether(desk, SamplePlacement::Merged);
    renderTogether(desk, SamplePlacement::Extra);
    renderReferences(desk);
    lookAtFrame(desk, shaders);
    return desk.outputs;
}

std::string differences(const Outputs& a, const Outputs& b) {
    std::string names;
    int count = a.size() == b.size() ? 0 : 1;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        if (a[i] != b[i] && ++count <= 10)
            names += (names.empty() ? "" : ", ") + a[i].first;
    return count == 0 ? "" : std::to_string(count) + " outputs: " + names;
}

ShaderLibrary freshShaders() {
    testContext();
    return ShaderLibrary(ShaderSource::fromDirectory(sourceDir() / "shaders"));
}

ShaderLibrary freshImageShaders() {
    testContext();
    return ShaderLibrary(ShaderSource::fromDirectory(sourceDir() / "shaders"),
                         Defines{{"FETCH_BY_IMAGE", "1"}});
}

ShaderLibrary& samplerShaders() {
    // Never destroyed: the context is gone by then.
    static ShaderLibrary& shaders = *new ShaderLibrary(freshShaders());
    return shaders;
}

} // namespace afterglow::test
