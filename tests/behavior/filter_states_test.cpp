// SPDX-License-Identifier: MIT
// Several filters on one raw signal, gradient samples beside the picture, and frames that are
// rendered again.

#include "renderer/scene/procedural.h"
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

Image<glm::vec4> signalOf(const Renderer& renderer, std::size_t state = 0) {
    return renderer.filteredSignal(state).read<glm::vec4>();
}

Settings withExtraSamples(Filter filter) {
    Settings settings = settingsOf(filter);
    settings.lighting.gradientSamples = int(SamplePlacement::Extra);
    return settings;
}

/// A renderer whose frames are asked for one by one, by the filters of a moment.
struct Bench {
    explicit Bench(std::string_view scene)
        : renderer(testShaders(), glInfo(testContext())), lights(4) {
        renderer.setScene(makeProceduralScene(scene));
        renderer.resize(kSize);
        camera = cameraAt(renderer.scene(), poseAt(renderer.scene(), 0.0));
        lights.resize(renderer.scene().lights.size());
    }

    /// The camera sways, the scene moves, and the first light goes out at frame 4.
    FrameInput input(std::uint32_t frame) {
        Camera swayed = camera;
        swayed.position.x += 0.01f * std::sin(0.9f * float(frame));
        lights[0].on = frame < 4;
        return {.camera = swayed,
                .seconds = double(frame) / 60.0,
                .frame = frame,
                .seed = 3,
                .lights = lights};
    }
    void render(std::uint32_t frame, std::span<const FilterRun> runs) {
        renderer.render(input(frame), settings, runs);
    }

    FrameSettings settings;
    Renderer renderer;
    Camera camera;
    std::vector<LightState> lights;
};

} // namespace

TEST_CASE("four filters on one raw signal are what each is alone on that signal, bit for bit") {
    const GlCheck noGlMessages;
    constexpr std::array filters{Filter::Svgf, Filter::Asvgf, Filter::Percentile, Filter::None};
    for (const auto placement : {SamplePlacement::Merged, SamplePlacement::Extra}) {
        CAPTURE(int(placement));
        std::vector<FilterRun> together;
        std::vector<std::unique_ptr<Bench>> alone;
        for (std::size_t i = 0; i < filters.size(); ++i) {
            Settings settings = settingsOf(filters[i]);
            settings.lighting.gradientSamples = int(placement);
            settings.denoiser.temporal.alpha = 0.1f + 0.05f * float(i);
            together.push_back({3 - i, settings});
            alone.push_back(std::make_unique<Bench>("hall"));
        }
        Bench bench("hall");
        bench.settings.lighting.gradientSamples = int(placement);
        for (std::uint32_t frame = 0; frame < 7; ++frame) {
            CAPTURE(frame);
            bench.render(frame, together);
            for (std::size_t i = 0; i < filters.size(); ++i) {
                CAPTURE(i);
                Settings own{bench.settings, together[i].settings};
                own.denoiser.alwaysCarrySamples = 1; // the merged samples of its neighbor
                alone[i]->renderer.render(alone[i]->input(frame), own);
                CHECK(differingPixels(signalOf(bench.renderer, 3 - i),
                                      signalOf(alone[i]->renderer)) == 0);
                CHECK(differingPixels(bench.renderer.display(3 - i).read<glm::u8vec4>(),
                                      alone[i]->renderer.display().read<glm::u8vec4>()) == 0);
            }
        }
        CHECK(differingPixels(signalOf(bench.renderer, 2), signalOf(bench.renderer, 3)) > 500);
        CHECK(bench.renderer.readStats().invalidValues == 0);
    }
}

TEST_CASE("a filter that joins goes on where the first one has come to") {
    const GlCheck noGlMessages;
    Bench bench("cornell");
    const Settings settings = settingsOf(Filter::Svgf);
    const std::array<FilterRun, 2> both{FilterRun{1, settings}, FilterRun{3, settings}};
    for (std::uint32_t frame = 0; frame < 3; ++frame)
        bench.render(frame, {both.data(), 1});
    CHECK_THROWS_AS(signalOf(bench.renderer, 3), std::logic_error);
    for (std::uint32_t frame = 3; frame < 6; ++frame) {
        bench.render(frame, both);
        CHECK(differingPixels(signalOf(bench.renderer, 1), signalOf(bench.renderer, 3)) == 0);
    }
    // Away for a while, it does not come back with what it had then.
    bench.render(6, {both.data(), 1});
    bench.render(7, both);
    CHECK(differingPixels(signalOf(bench.renderer, 1), signalOf(bench.renderer, 3)) == 0);

    const std::array<FilterRun, 2> twice{FilterRun{1, settings}, FilterRun{1, settings}};
    CHECK_THROWS_AS(bench.render(8, twice), std::logic_error);
    const FilterRun beyond{kFilterStates, settings};
    CHECK_THROWS_AS(bench.render(8, {&beyond, 1}), std::logic_error);
    CHECK_THROWS_AS(bench.render(8, {}), std::logic_error);
}

TEST_CASE("samples beside the picture leave the raw signal as it is without a gradient") {
    const GlCheck noGlMessages;
    Bench adaptive("hall"), plain("hall");
    for (std::uint32_t frame = 0; frame < 6; ++frame) {
        CAPTURE(frame);
        adaptive.renderer.render(adaptive.input(frame), withExtraSamples(Filter::Asvgf));
        plain.renderer.render(plain.input(frame), settingsOf(Filter::Svgf));
        CHECK(differingPixels(
                  adaptive.renderer.targets().signals[0].raw.current().read<glm::vec4>(),
                  plain.renderer.targets().signals[0].raw.current().read<glm::vec4>()) == 0);
        if (frame == 0)
            continue;
        // They are paid for: up to one more pair of rays in nine.
        const FrameStats more = adaptive.renderer.readStats(), less = plain.renderer.readStats();
        CHECK(more.gradientSamples > 150); // of 21 x 13
        CHECK(more.rays > less.rays + more.gradientSamples / 2);
        CHECK(more.rays <= less.rays + 2 * more.gradientSamples);
    }
}

TEST_CASE("samples beside the picture say what merged samples say, bit for bit") {
    const GlCheck noGlMessages;
    for (const char* scene : {"hall", "moving"}) {
        CAPTURE(scene);
        Bench merged(scene), extra(scene);
        int changed = 0;
        // Only in the second frame do both have the same candidates: merged samples are not offered
        // again.
        for (std::uint32_t frame = 3; frame < 5; ++frame) {
            merged.renderer.render(merged.input(frame), settingsOf(Filter::Asvgf));
            extra.renderer.render(extra.input(frame), withExtraSamples(Filter::Asvgf));
        }
        const auto a = imageOf(merged.renderer.targets(), svgf::kGradientSamples).read<glm::vec4>();
        const auto b = imageOf(extra.renderer.targets(), svgf::kGradientSamples).read<glm::vec4>();
        for (std::size_t i = 0; i < a.pixels().size(); ++i) {
            REQUIRE(glm::vec2(a.pixels()[i]) == glm::vec2(b.pixels()[i]));
            changed += a.pixels()[i].x != 0.0f;
        }
        CHECK(changed > 20);
        CHECK(differingPixels(merged.renderer.targets().samples.read<glm::uvec4>(),
                              extra.renderer.targets().samples.read<glm::uvec4>()) == 0);
    }
}

TEST_CASE("with samples beside a picture in which nothing changes A-SVGF is SVGF") {
    const GlCheck noGlMessages;
    Sequence adaptive(makeProceduralScene("cornell"), kSize, withExtraSamples(Filter::Asvgf));
    Sequence plain(makeProceduralScene("cornell"), kSize, settingsOf(Filter::Svgf));
    for (int i = 0; i < 8; ++i) {
        adaptive.next();
        plain.next();
        const auto lambda = imageOf(adaptive.targets(), svgf::kLambda).read<float>();
        for (const float l : lambda.pixels())
            REQUIRE(l == 0.0f);
        CHECK(differingPixels(adaptive.signal(), plain.signal()) == 0);
    }
    // And it is not for want of samples: the only light goes out.
    for (LightState& light : adaptive.lights)
        light.on = false;
    adaptive.settings.lighting.signal = int(Signal::Shadows);
    adaptive.next();
    const auto lambda = imageOf(adaptive.targets(), svgf::kLambda).read<float>();
    CHECK(std::ranges::count(lambda.pixels(), 1.0f) > 100); // of 273, some of which are dark
}

TEST_CASE("frames rendered again from a checkpoint have the same bits") {
    const GlCheck noGlMessages;
    for (const auto& [placement, signal] : {std::pair(SamplePlacement::Merged, Signal::Both),
                                            {SamplePlacement::Extra, Signal::Both},
                                            {SamplePlacement::Extra, Signal::Separate}}) {
        CAPTURE(int(placement));
        CAPTURE(nameOf(signal));
        Bench bench("moving");
        std::vector<FilterRun> runs{{0, settingsOf(Filter::Asvgf)}, {2, settingsOf(Filter::Fixed)}};
        bench.settings.lighting = {.signal = int(signal), .gradientSamples = int(placement)};
        const std::size_t signals = signalsOf(signal).size();
        const auto images = [&] {
            std::vector<Image<glm::vec4>> all;
            for (const FilterRun& run : runs)
                for (std::size_t i = 0; i < signals; ++i)
                    all.push_back(bench.renderer.filteredSignal(run.state, i).read<glm::vec4>());
            return all;
        };
        for (std::uint32_t frame = 0; frame < 3; ++frame)
            bench.render(frame, runs);
        const HistoryCheckpoint kept = bench.renderer.checkpoint();
        CHECK(kept.bytes() == 61u * 37u * (16u + 4u + 16u + signals * (16u + 2u * 32u)));
        std::vector<std::vector<Image<glm::vec4>>> first;
        for (std::uint32_t frame = 3; frame < 7; ++frame) {
            bench.render(frame, runs);
            first.push_back(images());
        }
        bench.render(40, {runs.data(), 1});
        FrameSettings other = bench.settings;
        other.lighting.signal = int(Signal::AmbientOcclusion);
        bench.renderer.beginReference(bench.input(3), other);
        bench.renderer.addReferenceSamples(2);
        bench.renderer.finishReference();
        bench.renderer.restore(kept);
        std::size_t next = 0;
        for (std::uint32_t frame = 3; frame < 7; ++frame) {
            bench.render(frame, runs);
            const auto again = images();
            for (std::size_t i = 0; i < again.size(); ++i)
                CHECK(differingPixels(first[next][i], again[i]) == 0);
            ++next;
        }
        bench.renderer.resize({5, 3});
        CHECK_THROWS_AS(bench.renderer.restore(kept), std::logic_error);
    }
}

TEST_CASE("a listener hears of every pass in order, with what it made") {
    const GlCheck noGlMessages;
    struct Ear final : PassListener {
        std::vector<std::string> passes;
        std::vector<Image<glm::vec4>> blends; ///< of every a-trous iteration
        void passDone(std::string_view pass, std::span<const GpuTexture* const> made) override {
            passes.emplace_back(pass);
            REQUIRE(!made.empty());
            if (pass == "a-trous")
                blends.push_back(made[0]->read<glm::vec4>());
        }
    } ear;
    Bench bench("tiny");
    bench.renderer.setListener(&ear);
    const FilterRun run{0, settingsOf(Filter::Asvgf)};
    bench.render(0, {&run, 1});
    CHECK(ear.passes ==
          std::vector<std::string>{"visibility",       "resolve",          "forward projection",
                                   "surface",          "strata",           "lighting",
                                   "gradient",         "gradient a-trous", "gradient a-trous",
                                   "gradient a-trous", "gradient a-trous", "gradient a-trous",
                                   "lambda",           "temporal",         "variance",
                                   "a-trous",          "a-trous",          "a-trous",
                                   "a-trous",          "a-trous",          "composite",
                                   "tone map"});
    REQUIRE(ear.blends.size() == 5);
    for (std::size_t i = 1; i < 5; ++i)
        CHECK(differingPixels(ear.blends[i - 1], ear.blends[i]) > 500);
    CHECK(differingPixels(ear.blends.back(), signalOf(bench.renderer)) == 0);
    ear.passes.clear();
    bench.renderer.setListener(nullptr);
    bench.render(1, {&run, 1});
    CHECK(ear.passes.empty());
}
