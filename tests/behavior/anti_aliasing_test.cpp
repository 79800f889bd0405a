// SPDX-License-Identifier: MIT
// Edges, smoothed over time; and the automatic exposure, which is kept with them.

#include "renderer/image/metrics.h"
#include "renderer/pipeline/aov.h"
#include "renderer/pipeline/jitter.h"
#include "renderer/scene/procedural.h"
#include "renderer/scene/scene_builder.h"
#include "renderer/scene/shapes.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/sequence.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

using namespace afterglow;
using namespace afterglow::test;

namespace {

constexpr glm::ivec2 kSize{61, 37};

Settings smoothed(Settings settings, TaaOrder order = DisplaySettings().taaOrder == 0
                                                          ? TaaOrder::BeforeToneMap
                                                          : TaaOrder::AfterToneMap) {
    settings.display.antiAliasing = int(AntiAliasing::Taa);
    settings.display.taaOrder = int(order);
    return settings;
}

/// Surfaces that only shine, so that a frame without a filter has no noise: its edges are all that
/// there is to see. `brightest`: radiance of some of them.
Scene glowing(float brightest) {
    SceneBuilder scene("glowing");
    const auto panel = [&](const std::string& name, glm::vec3 center, glm::vec3 right, glm::vec3 up,
                           glm::vec3 radiance) {
        Mesh mesh;
        addQuadFacing(mesh, {0.0f, 0.0f, 1.0f}, center - right - up, center + right - up,
                      center + right + up, center - right + up);
        scene.light(name, std::move(mesh), radiance);
    };
    panel("wall", {0, 0, -3}, {4, 0.3f, 0.2f}, {-0.2f, 1.4f, 0}, {0.05f, 0.08f, 0.12f});
    panel("sheet", {-0.9f, 0.3f, -1}, {0.7f, 0.23f, 0}, {-0.2f, 0.6f, 0}, {0.6f, 0.4f, 0.2f});
    panel("lamp", {0.8f, 0.5f, -0.5f}, {0.4f, -0.15f, 0.2f}, {0.1f, 0.3f, 0}, glm::vec3(brightest));
    for (int i = 0; i < 4; ++i) // bars of about two pixels
        panel("bar " + std::to_string(i), {-1.2f + 0.45f * float(i), -0.7f, 0.1f},
              {0.06f, 0.02f, 0}, {0.12f, 0.4f, 0}, {0.3f, 0.7f, 0.5f});
    Mesh ring;
    addTorus(ring, {0.9f, -0.6f, 0.0f}, 0.35f, 0.09f, 40, 16);
    scene.light("ring", std::move(ring), {0.8f, 0.2f, 0.3f});
    scene.camera(lookAt({0.1f, 0.1f, 3.2f}, {0.0f, 0.05f, 0.0f}));
    return std::move(scene).finish();
}

Settings plain() {
    return settingsOf(Filter::None, Signal::Shadows);
}

/// Averages the linear radiance of 8x8 points of each pixel, on a grid.
Image<glm::vec4> supersampled(Sequence& large) {
    large.next();
    const auto fine = large.targets().filters[0].composed.read<glm::vec4>();
    Image<glm::vec4> out(fine.size() / 8);
    for (int y = 0; y < out.size().y; ++y)
        for (int x = 0; x < out.size().x; ++x) {
            glm::dvec4 sum(0.0);
            for (int k = 0; k < 64; ++k)
                sum += glm::dvec4(fine({8 * x + k % 8, 8 * y + k / 8}));
            out({x, y}) = glm::vec4(sum / 64.0);
        }
    return out;
}

/// As the display shows it, in [0, 1]: ACES and sRGB.
glm::dvec3 onDisplay(const glm::dvec3& x) {
    glm::dvec3 out;
    for (int k = 0; k < 3; ++k) {
        const double f =
            std::min(1.0, x[k] * (2.51 * x[k] + 0.03) / (x[k] * (2.43 * x[k] + 0.59) + 0.14));
        out[k] = f <= 0.0031308 ? 12.92 * f : 1.055 * std::pow(f, 1.0 / 2.4) - 0.055;
    }
    return out;
}

/// By pixel, of what is shown minus the supersampled picture.
std::vector<glm::dvec3> errorsOf(const Renderer& renderer, const Image<glm::vec4>& truth) {
    const auto shown = renderer.display().read<glm::u8vec4>();
    std::vector<glm::dvec3> errors;
    for (std::size_t i = 0; i < truth.pixels().size(); ++i)
        errors.push_back(glm::dvec3(shown.pixels()[i]) / 255.0 -
                         onDisplay(glm::dvec3(truth.pixels()[i])));
    return errors;
}

double rms(const std::vector<glm::dvec3>& values) {
    double sum = 0.0;
    for (const glm::dvec3& v : values)
        sum += glm::dot(v, v) / 3.0;
    return std::sqrt(sum / double(values.size()));
}

std::vector<glm::dvec3> minus(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
    std::vector<glm::dvec3> out;
    for (std::size_t i = 0; i < a.size(); ++i)
        out.push_back(a[i] - b[i]);
    return out;
}

/// Of a still picture, after a cycle and in the frames that follow.
struct Still {
    double afterCycle = 0.0, settled = 0.0, flicker = 0.0;
};
Still stillOf(float brightest, const Settings& settings) {
    Sequence fine(glowing(brightest), 8 * kSize, plain()),
        shown(glowing(brightest), kSize, settings);
    const Image<glm::vec4> truth = supersampled(fine);
    shown.run(int(kJitterCycle));
    Still still;
    std::vector<glm::dvec3> before = errorsOf(shown.renderer(), truth);
    still.afterCycle = rms(before);
    shown.run(3 * int(kJitterCycle));
    before = errorsOf(shown.renderer(), truth);
    for (std::uint32_t i = 0; i < kJitterCycle; ++i) {
        shown.next();
        const auto now = errorsOf(shown.renderer(), truth);
        still.settled += rms(now) / kJitterCycle;
        still.flicker += rms(minus(now, before)) / kJitterCycle;
        before = now;
    }
    return still;
}

/// Of a picture through which the camera drifts by a fraction of a pixel a frame.
struct Drift {
    double error = 0.0;
    double crawl = 0.0; ///< change of the error from frame to frame
};
Drift driftOf(float brightest, const Settings& settings) {
    Sequence fine(glowing(brightest), 8 * kSize, plain()),
        shown(glowing(brightest), kSize, settings);
    Drift drift;
    std::vector<glm::dvec3> before;
    constexpr int kLeadIn = 20, kFrames = 24;
    for (int i = 0; i < kLeadIn + kFrames; ++i) {
        for (Sequence* each : {&fine, &shown})
            each->camera.position += glm::vec3(0.009f, 0.004f, 0.0f);
        shown.next();
        if (i + 1 < kLeadIn)
            continue;
        const auto now = errorsOf(shown.renderer(), supersampled(fine));
        if (!before.empty()) {
            drift.error += rms(now) / kFrames;
            drift.crawl += rms(minus(now, before)) / kFrames;
        }
        before = now;
    }
    return drift;
}

} // namespace

TEST_CASE("the places in a pixel are spread evenly around its center") {
    glm::dvec2 sum(0.0);
    int cells[4][4] = {};
    for (std::uint32_t frame = 0; frame < kJitterCycle; ++frame) {
        const glm::vec2 place = jitterAt(frame);
        CHECK(std::abs(place.x) < 0.5f);
        CHECK(std::abs(place.y) < 0.5f);
        CHECK(jitterAt(frame + kJitterCycle) == place);
        sum += glm::dvec2(place);
        ++cells[int(4.0f * (place.y + 0.5f))][int(4.0f * (place.x + 0.5f))];
    }
    CHECK(jitterAt(0) == glm::vec2(0.0f, float(1.0 / 3.0 - 0.5)));
    CHECK(jitterAt(4) == glm::vec2(0.125f, float(7.0 / 9.0 - 0.5)));
    CHECK(glm::length(sum) / kJitterCycle < 0.05); // the picture stays where it is
    for (int k = 0; k < 4; ++k) {
        int row = 0, column = 0;
        for (int other = 0; other < 4; ++other) {
            row += cells[k][other];
            column += cells[other][k];
        }
        CHECK(column == int(kJitterCycle) / 4);
        CHECK(std::abs(row - int(kJitterCycle) / 4) <= 1);
    }
}

TEST_CASE("in a still picture every carried sample is the very same point: delta is 0") {
    const GlCheck noGlMessages;
    struct Case {
        const char* scene;
        Signal signal;
    };
    for (const Case& c :
         {Case{"cornell", Signal::Both}, Case{"hall", Signal::Both}, Case{"hall", Signal::Split}}) {
        CAPTURE(c.scene);
        CAPTURE(nameOf(c.signal));
        Sequence sequence(makeProceduralScene(c.scene), kSize,
                          smoothed(settingsOf(Filter::Asvgf, c.signal)));
        int samples = 0, moved = 0;
        Image<glm::uvec4> before;
        for (std::uint32_t i = 0; i < kJitterCycle + 4; ++i) {
            sequence.next();
            const RenderTargets& t = sequence.targets();
            const auto now = t.surfaces.visibility.read<glm::uvec4>();
            if (i > 0)
                moved += differingPixels(now, before);
            before = now;
            const auto carried = t.samples.read<glm::uvec4>();
            for (const glm::uvec4& sample : carried.pixels())
                samples += sample.y != 0u;
            for (std::size_t signal = 0; signal < sequence.renderer().signals().size(); ++signal) {
                const auto gradient =
                    imageOf(t, svgf::kGradientSamples, 0, signal).read<glm::vec4>();
                for (const glm::vec4& g : gradient.pixels())
                    REQUIRE(g.x == 0.0f);
            }
            const auto motion = t.surfaces.motion.read<glm::vec4>();
            for (const glm::vec4& m : motion.pixels())
                REQUIRE(glm::vec2(m) == glm::vec2(0.0f)); // free of jitter
        }
        CHECK(samples > 100 * int(kJitterCycle)); // of 21 x 13
        CHECK(moved > 1000 * int(kJitterCycle));  // new places all the time
    }
}

TEST_CASE("without anti-aliasing nothing is jittered and nothing is kept for it") {
    const GlCheck noGlMessages;
    Sequence sequence(makeProceduralScene("cornell"), kSize, settingsOf(Filter::Asvgf));
    sequence.run(2);
    const auto bytes = sequence.targets().bytes();
    Sequence toggled(makeProceduralScene("cornell"), kSize, smoothed(settingsOf(Filter::Asvgf)));
    toggled.settings.display.autoExposure = 1;
    toggled.run(2);
    CHECK(toggled.targets().bytes() > bytes + 61 * 37 * 32);
    toggled.settings.display = {};
    toggled.next();
    CHECK(toggled.targets().bytes() == bytes);
    sequence.settings.filter = toggled.settings.filter = Filter::None;
    sequence.next();
    sequence.next();
    toggled.next();
    CHECK(differingPixels(sequence.targets().surfaces.visibility.read<glm::uvec4>(),
                          toggled.targets().surfaces.visibility.read<glm::uvec4>()) == 0);
    CHECK(differingPixels(sequence.renderer().display().read<glm::u8vec4>(),
                          toggled.renderer().display().read<glm::u8vec4>()) == 0);
}

TEST_CASE("after one cycle a still picture is near to one of 64 points a pixel") {
    const GlCheck noGlMessages;
    for (const float brightest : {0.9f, 30.0f}) {
        const Still off = stillOf(brightest, plain());
        MESSAGE("brightest ", brightest, ", off: RMSE ", off.settled, ", flicker ", off.flicker);
        CHECK(off.flicker == 0.0);
        for (const TaaOrder order : {TaaOrder::BeforeToneMap, TaaOrder::AfterToneMap}) {
            const Still taa = stillOf(brightest, smoothed(plain(), order));
            MESSAGE("brightest ", brightest, ", order ", int(order), ": RMSE after a cycle ",
                    taa.afterCycle, ", settled ", taa.settled, ", flicker ", taa.flicker);
            // Lamps of 30 have edges that no average of few points smooths on the display.
            CHECK(taa.afterCycle < (brightest < 1.0f ? 0.35 : 0.55) * off.settled);
            CHECK(taa.settled < (brightest < 1.0f ? 0.35 : 0.55) * off.settled);
            CHECK(taa.flicker < 0.2 * off.settled);
        }
    }
}

TEST_CASE("edges that drift by a fraction of a pixel crawl no more") {
    const GlCheck noGlMessages;
    for (const float brightest : {0.9f, 30.0f}) {
        const Drift off = driftOf(brightest, plain());
        MESSAGE("brightest ", brightest, ", off: error ", off.error, ", crawl ", off.crawl);
        for (const TaaOrder order : {TaaOrder::BeforeToneMap, TaaOrder::AfterToneMap}) {
            const Drift taa = driftOf(brightest, smoothed(plain(), order));
            MESSAGE("brightest ", brightest, ", order ", int(order), ": error ", taa.error,
                    ", crawl ", taa.crawl);
            CHECK(taa.error < 0.7 * off.error);
            CHECK(taa.crawl < 0.5 * off.crawl);
        }
    }
}

namespace {

bool isOneFrame(const Image<glm::vec4>& resolved) {
    return std::ranges::all_of(resolved.pixels(), [](const glm::vec4& p) { return p.a == 1.0f; });
}

/// The camera sways and the key light goes out at frame 4; two filters.
struct Bench {
    Bench() : renderer(testShaders(), glInfo(testContext())), lights(4) {
        renderer.setScene(makeProceduralScene("moving"));
        renderer.resize(kSize);
        settings = smoothed(settingsOf(Filter::Asvgf));
        settings.display.autoExposure = 1;
        camera = cameraAt(renderer.scene(), poseAt(renderer.scene(), 0.0));
        lights.resize(renderer.scene().lights.size());
    }
    void render(std::uint32_t frame) {
        Camera swayed = camera;
        swayed.position.x += 0.02f * std::sin(0.9f * float(frame));
        lights[0].on = frame < 4;
        const std::array<FilterRun, 2> runs{FilterRun{0, settingsOf(Filter::Asvgf)},
                                            FilterRun{2, settingsOf(Filter::Fixed)}};
        renderer.render({.camera = swayed,
                         .seconds = double(frame) / 60.0,
                         .frame = frame,
                         .seed = 3,
                         .lights = lights},
                        settings, runs);
    }
    /// All that is kept for the display, and the display.
    std::vector<Image<glm::vec4>> images() const {
        const RenderTargets& t = renderer.targets();
        std::vector<Image<glm::vec4>> all{t.exposure.current().read<glm::vec4>()};
        for (const std::size_t state : {0, 2})
            all.push_back(t.filters[state].resolved.current().read<glm::vec4>());
        return all;
    }
    int differing(const std::vector<Image<glm::vec4>>& other) const {
        const auto own = images();
        int count = 0;
        for (std::size_t i = 0; i < own.size(); ++i)
            count += differingPixels(own[i], other[i]);
        return count;
    }

    Renderer renderer;
    Settings settings;
    Camera camera;
    std::vector<LightState> lights;
};

} // namespace

TEST_CASE("what the display has come to is the same in every run, and again from a checkpoint") {
    const GlCheck noGlMessages;
    for (const TaaOrder order : {TaaOrder::BeforeToneMap, TaaOrder::AfterToneMap}) {
        Bench bench, other;
        bench.settings.display.taaOrder = other.settings.display.taaOrder = int(order);
        for (std::uint32_t frame = 0; frame < 3; ++frame) {
            bench.render(frame);
            other.render(frame);
        }
        CHECK(bench.differing(other.images()) == 0);
        const HistoryCheckpoint kept = bench.renderer.checkpoint();
        std::vector<std::vector<Image<glm::vec4>>> first;
        for (std::uint32_t frame = 3; frame < 7; ++frame) {
            bench.render(frame);
            first.push_back(bench.images());
        }
        bench.settings.display.antiAliasing = bench.settings.display.autoExposure = 0;
        bench.render(40); // all of it is dropped
        bench.settings = other.settings;
        bench.renderer.restore(kept);
        for (std::uint32_t frame = 3; frame < 7; ++frame) {
            bench.render(frame);
            CHECK(bench.differing(first[frame - 3]) == 0);
        }
        // And it is not that nothing is kept: without the checkpoint other frames follow.
        bench.renderer.resetHistory();
        bench.render(6);
        CHECK(bench.differing(first[3]) > 500);
        CHECK(isOneFrame(bench.images()[1]));
        bench.renderer.resize({40, 30});
        bench.render(7);
        CHECK(isOneFrame(bench.images()[1]));
        CHECK_THROWS_AS(bench.renderer.restore(kept), std::logic_error);
    }
}

TEST_CASE("all filters of a frame are shown at one exposure, which follows the light") {
    const GlCheck noGlMessages;
    Bench bench;
    bench.settings.display.exposureFrames = 4.0f;
    bench.settings.display.antiAliasing = int(AntiAliasing::Off);
    bench.render(0);
    const auto stopsNow = [&] {
        return bench.renderer.targets().exposure.current().read<glm::vec4>()({0, 0}).x;
    };
    const float lit = stopsNow();
    for (std::uint32_t frame = 1; frame < 4; ++frame)
        bench.render(frame);
    CHECK(stopsNow() == doctest::Approx(double(lit)).epsilon(0.2));
    float last = stopsNow();
    for (std::uint32_t frame = 4; frame < 12; ++frame) {
        bench.render(frame);
        CHECK(stopsNow() > last); // a light went out: brighter, little by little
        last = stopsNow();
    }
}

TEST_CASE("a reference looks where its frame looked, and is no average over time") {
    const GlCheck noGlMessages;
    Sequence sequence(glowing(0.9f), kSize, smoothed(plain()));
    sequence.run(5);
    const auto seen = sequence.targets().surfaces.visibility.read<glm::uvec4>();
    const FrameInput moment{.camera = sequence.camera,
                            .seconds = 0.0,
                            .frame = 4,
                            .seed = 1,
                            .lights = sequence.lights};
    Renderer& renderer = sequence.renderer();
    renderer.beginReference(moment, sequence.settings);
    renderer.addReferenceSamples(1);
    renderer.finishReference();
    CHECK(differingPixels(sequence.targets().surfaces.visibility.read<glm::uvec4>(), seen) == 0);
    CHECK(sequence.targets().filters[0].resolved.current().size().x == 0);
    renderer.beginReference(moment, plain());
    CHECK(differingPixels(sequence.targets().surfaces.visibility.read<glm::uvec4>(), seen) > 500);
}
