// SPDX-License-Identifier: MIT
// The truth of a frozen frame, against experiments and against what must be.

#include "app/measure/meter.h"
#include "app/measure/truth.h"
#include "app/workbench/oracle_view.h"
#include "renderer/pipeline/aov.h"
#include "renderer/scene/procedural.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/sequence.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <stdexcept>

using namespace afterglow;
using namespace afterglow::test;

namespace {

constexpr glm::ivec2 kSize{61, 37};

/// A renderer and what the oracle has to know of its last two frames.
struct Watched {
    explicit Watched(std::string_view scene, glm::ivec2 size = kSize)
        : renderer(testShaders(), glInfo(testContext())) {
        renderer.setScene(makeProceduralScene(scene));
        renderer.resize(size);
        lights.resize(renderer.scene().lights.size());
        camera = cameraAt(renderer.scene(), poseAt(renderer.scene(), 0.0));
    }
    void render(std::span<const FilterRun> filters) {
        runs.assign(filters.begin(), filters.end());
        if (frame > 0)
            moment.before = moment.now;
        moment.seed = 7;
        moment.now = {.seconds = secondsPerFrame * double(frame),
                      .camera = camera,
                      .lights = lights,
                      .marks = {},
                      .step = false};
        renderer.render(inputNow(), settings, runs);
        ++frame;
    }
    void render(const Settings& all) {
        settings = all;
        const FilterRun run{0, all};
        render({&run, 1});
    }

    FrameInput inputNow() const {
        return {.camera = camera,
                .seconds = moment.now.seconds,
                .frame = frame,
                .seed = 7,
                .lights = lights};
    }

    Renderer renderer;
    Camera camera;
    std::vector<LightState> lights;
    double secondsPerFrame = 0.0;
    std::uint32_t frame = 0;
    OracleView::Frozen moment;
    FrameSettings settings;
    std::vector<FilterRun> runs; ///< of the last frame
};

void finish(OracleView& oracle) {
    while (!oracle.isDone())
        oracle.advance(100.0);
}

OracleView makeOracle() {
    return OracleView(testShaders(), glInfo(testContext()));
}

/// In the order of truthImages().
enum OracleImage : std::size_t { kError, kReference, kLambda, kLambdaError, kAlpha, kAlphaError };

Image<float> readImage(OracleView& oracle, OracleImage image, std::size_t state) {
    const GpuTexture* texture = oracle.image(image, state);
    REQUIRE(texture != nullptr);
    return channelOf(texture->read<glm::vec4>(), 0);
}

double largest(const Image<float>& image) {
    double most = 0.0;
    for (const float value : image.pixels())
        most = std::max(most, double(std::abs(value)));
    return most;
}

} // namespace

TEST_CASE("a frozen frame has the error and the ideal lambda that an experiment measures there") {
    const GlCheck noGlMessages;
    const Experiment experiment =
        parseExperiment(R"({"name": "t", "scene": "tiny", "size": [61, 37], "frames": 4, "seed": 7,
                            "variants": ["asvgf"], "referenceSamples": 6,
                            "timeline": [{"frame": 3, "light": "key", "power": 0.25}]})",
                        "t.json");
    const StagedRun run = stagedRun(experiment);
    Renderer judge(testShaders(), glInfo(testContext()));
    judge.setScene(run.scene);
    judge.resize(kSize);
    ReferenceStore store(ReferenceMaker("", "", "", ""));
    Truths truths(experiment, run.plan);
    truths.make(judge, store, {0, 4}, [](int) {});

    Watched watched("tiny");
    const Settings settings = settingsOf(Filter::Asvgf);
    for (int i = 0; i < 4; ++i) {
        watched.lights[0].power = i < 3 ? 1.0f : 0.25f;
        watched.render(settings);
    }
    OracleView oracle = makeOracle();
    oracle.begin(watched.renderer, watched.moment, watched.settings, experiment.referenceSamples);
    finish(oracle);
    const Truth& truth = truths.at(3);
    const Image<float> ideal = truth.idealLambda(0, settings.denoiser.gradient.deltaFloor).lambda;
    CHECK(largest(ideal) > 0.1);
    CHECK(differingPixels(readImage(oracle, kLambda, 0), ideal) == 0);
    CHECK(differingPixels(oracle.image(kReference, 0)->read<glm::vec4>(), truth.lit) == 0);
    CHECK(oracle.rmse(0) ==
          rmse(readFrame(watched.renderer, false).lit, truth.lit, &truth.foreground));
}

TEST_CASE("with the only light gone the ideal lambda is 1 where it shone, and A-SVGF has it") {
    const GlCheck noGlMessages;
    Watched watched("tiny");
    const Settings settings = settingsOf(Filter::Asvgf, Signal::Shadows);
    for (int i = 0; i < 6; ++i) {
        watched.lights[0].on = i < 5;
        watched.render(settings);
    }
    OracleView oracle = makeOracle();
    oracle.begin(watched.renderer, watched.moment, watched.settings, 16);
    finish(oracle);
    const Image<float> ideal = readImage(oracle, kLambda, 0);
    CHECK(std::ranges::all_of(ideal.pixels(), [](float l) { return l == 0.0f || l == 1.0f; }));
    CHECK(std::ranges::count(ideal.pixels(), 1.0f) > 100); // of 273
    const Image<float> error = readImage(oracle, kLambdaError, 0);
    // Where no sample has landed around, it says nothing.
    const auto missed = std::ranges::count_if(error.pixels(), [](float e) { return e < -1e-3f; });
    CHECK(missed < 0.03 * double(std::ranges::count(ideal.pixels(), 1.0f))); // 2 of 118
    CHECK(std::ranges::all_of(error.pixels(), [](float e) { return e <= 0.0f; }));
    // The truth is black, and a history of light is all error.
    const auto reference = oracle.image(kReference, 0)->read<glm::vec4>();
    CHECK(reference.size() == kSize);
    const Image<float> alpha = readImage(oracle, kAlpha, 0);
    CHECK(std::ranges::count(alpha.pixels(), 1.0f) > 800);
}

TEST_CASE("two references of one moment are equal where nothing that can be seen has changed") {
    const GlCheck noGlMessages;
    Watched watched("rooms"); // one light shines in another room
    const Settings settings = settingsOf(Filter::Asvgf);
    for (int i = 0; i < 3; ++i) {
        watched.lights[1].on = i < 2;
        watched.render(settings);
    }
    REQUIRE(watched.moment.now.lights != watched.moment.before->lights);
    OracleView oracle = makeOracle();
    oracle.begin(watched.renderer, watched.moment, watched.settings, 4);
    finish(oracle);
    CHECK(largest(readImage(oracle, kLambda, 0)) == 0.0);
}

TEST_CASE("the error of a picture falls towards that of a converged one, and so does rmse") {
    const GlCheck noGlMessages;
    Watched watched("cornell");
    std::vector<FilterRun> runs{{0, settingsOf(Filter::None)}, {2, settingsOf(Filter::Svgf)}};
    for (int i = 0; i < 16; ++i)
        watched.render(runs);
    OracleView oracle = makeOracle();
    oracle.begin(watched.renderer, watched.moment, watched.settings, 128);
    finish(oracle);
    const double raw = oracle.rmse(0).value();
    const double filtered = oracle.rmse(2).value();
    CHECK(raw > 0.1);
    CHECK(filtered < 0.5 * raw);

    const auto error = readImage(oracle, kError, 0);
    double sum = 0.0;
    for (const float e : error.pixels())
        sum += e;
    CHECK(std::abs(sum / double(error.pixels().size())) < 0.1 * raw); // noise has no bias
    CHECK_FALSE(oracle.rmse(1));
    CHECK(oracle.image(kError, 1) == nullptr);
}

TEST_CASE("an oracle says nothing of what a filter does not have") {
    const GlCheck noGlMessages;
    Watched watched("tiny");
    std::vector<FilterRun> runs{{0, settingsOf(Filter::None)},
                                {1, settingsOf(Filter::Percentile)},
                                {3, settingsOf(Filter::Fixed)}};
    OracleView oracle = makeOracle();
    CHECK_THROWS_AS(oracle.begin(watched.renderer, watched.moment, {}, 2), std::logic_error);
    watched.render(runs);
    for (const bool hasBefore : {false, true}) {
        if (hasBefore)
            watched.render(runs);
        oracle.begin(watched.renderer, watched.moment, watched.settings, 2);
        for (std::size_t image = 0; image < truthImages().size(); ++image)
            CHECK(oracle.image(image, 0) == nullptr);
        CHECK_FALSE(oracle.rmse(0));
        finish(oracle);
        const auto has = [&](OracleImage image, std::size_t run) {
            return oracle.image(image, runs[run].state) != nullptr;
        };
        for (std::size_t run = 0; run < runs.size(); ++run) {
            CHECK(has(kReference, run));
            CHECK(has(kError, run));
            CHECK_FALSE(has(kLambda, run));
            CHECK_FALSE(has(kLambdaError, run));
            CHECK(has(kAlpha, run) == (run > 0));
            CHECK(has(kAlphaError, run) == (run > 0));
        }
        // Without a history the ideal is to take the newest sample.
        if (!hasBefore) {
            const Image<float> alpha = readImage(oracle, kAlpha, 3);
            CHECK(std::ranges::count(alpha.pixels(), 1.0f) ==
                  std::ptrdiff_t(countOf(foregroundOf(watched.renderer))));
            CHECK(largest(readImage(oracle, kAlphaError, 3)) == 0.0);
        }
    }
    const Settings adaptive = settingsOf(Filter::Asvgf);
    watched.render(adaptive);
    oracle.begin(watched.renderer, watched.moment, watched.settings, 2);
    finish(oracle);
    CHECK(oracle.image(kLambda, 0) != nullptr);
    oracle.end();
    CHECK_FALSE(oracle.isActive());
    CHECK_FALSE(oracle.isDone());
    CHECK(oracle.progress() == 0.0);
    CHECK(oracle.image(kLambda, 0) == nullptr);
    CHECK_FALSE(oracle.advance(1.0));
}

TEST_CASE("an image is made once, and by the settings that the filter ran with") {
    const GlCheck noGlMessages;
    Watched watched("tiny");
    Settings settings = settingsOf(Filter::Asvgf);
    watched.render(settings);
    watched.lights[0].power = 0.5f;
    watched.render(settings);
    OracleView oracle = makeOracle();
    const auto lambdaNow = [&] {
        oracle.begin(watched.renderer, watched.moment, watched.settings, 4);
        finish(oracle);
        return readImage(oracle, kLambda, 0);
    };
    const Image<float> first = lambdaNow();
    CHECK(largest(first) > 0.1);
    const GLuint name = oracle.image(kLambda, 0)->id();
    CHECK(oracle.image(kLambda, 0)->id() == name);
    watched.settings.display.exposure = 2.0f; // nothing to do with it
    CHECK(differingPixels(lambdaNow(), first) == 0);
    settings.denoiser.gradient.deltaFloor = 1e6f;
    watched.lights[0].power = 1.0f;
    watched.render(settings);
    CHECK(largest(lambdaNow()) == 0.0);
}

TEST_CASE("the frames of a watched renderer are the same bits with an oracle in between") {
    const GlCheck noGlMessages;
    Watched watched("moving"), alone("moving");
    watched.secondsPerFrame = alone.secondsPerFrame = 1.0 / 30.0;
    const std::vector<FilterRun> runs{{0, settingsOf(Filter::Asvgf)},
                                      {1, settingsOf(Filter::Svgf)}};
    OracleView oracle = makeOracle();
    for (int frame = 0; frame < 6; ++frame) {
        CAPTURE(frame);
        watched.lights[0].on = alone.lights[0].on = frame < 3;
        watched.render(runs);
        alone.render(runs);
        for (const FilterRun& run : runs)
            CHECK(differingPixels(watched.renderer.filteredSignal(run.state).read<glm::vec4>(),
                                  alone.renderer.filteredSignal(run.state).read<glm::vec4>()) == 0);
        CHECK(differingPixels(watched.renderer.targets().samples.read<glm::uvec4>(),
                              alone.renderer.targets().samples.read<glm::uvec4>()) == 0);
        if (frame == 2 || frame == 3)
            oracle.begin(watched.renderer, watched.moment, watched.settings, 8);
        oracle.advance(0.0);
    }
    // Nor do its frames disturb the oracle, which goes on from moment to moment.
    Watched still("moving");
    still.secondsPerFrame = 1.0 / 30.0;
    for (int frame = 0; frame < 4; ++frame) {
        still.lights[0].on = frame < 3;
        still.render(runs);
    }
    OracleView undisturbed = makeOracle();
    undisturbed.begin(still.renderer, still.moment, still.settings, 8);
    finish(undisturbed);
    CHECK_FALSE(oracle.isDone());
    finish(oracle);
    for (const OracleImage image : {kError, kLambda, kAlpha})
        for (const FilterRun& run : runs)
            if (image != kLambda || run.settings.filter == Filter::Asvgf)
                CHECK(differingPixels(readImage(oracle, image, run.state),
                                      readImage(undisturbed, image, run.state)) == 0);
}

TEST_CASE("progress rises from 0 to 1, in portions of about the time that is asked for") {
    const GlCheck noGlMessages;
    Watched watched("cornell");
    const Settings settings = settingsOf(Filter::Asvgf);
    for (int i = 0; i < 2; ++i) {
        watched.lights[0].on = i == 0;
        watched.render(settings);
    }
    OracleView oracle = makeOracle();
    CHECK(oracle.progress() == 0.0);
    oracle.begin(watched.renderer, watched.moment, watched.settings, 200);
    CHECK(oracle.isActive());
    CHECK(oracle.progress() == 0.0);
    int calls = 0;
    std::vector<double> times;
    for (bool isDone = false; !isDone && calls < 1000; ++calls) {
        const auto start = std::chrono::steady_clock::now();
        isDone = oracle.advance(25.0);
        times.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
                .count());
        CHECK(isDone == oracle.isDone());
        CHECK((oracle.progress() == 1.0) == isDone);
    }
    CHECK_FALSE(oracle.advance(25.0));
    REQUIRE(calls > 4);
    std::ranges::nth_element(times, times.begin() + calls / 2);
    CAPTURE(calls);
    CAPTURE(times[std::size_t(calls) / 2]);
    // Half of them, since others use this machine as well.
    CHECK(times[std::size_t(calls) / 2] > 8.0);
    CHECK(times[std::size_t(calls) / 2] < 200.0);

    // No time at all is one sample.
    oracle.begin(watched.renderer, watched.moment, watched.settings, 2);
    for (int i = 0; i < 4; ++i)
        CHECK(oracle.advance(0.0) == (i == 3));
}

TEST_CASE("an oracle of a picture without surfaces, or of one pixel, says so calmly") {
    const GlCheck noGlMessages;
    const Settings settings = settingsOf(Filter::Asvgf);
    Watched away("tiny");
    away.camera = lookAt({0.0f, 1.0f, 10.0f}, {0.0f, 1.0f, 20.0f});
    away.render(settings);
    away.render(settings);
    OracleView oracle = makeOracle();
    oracle.begin(away.renderer, away.moment, away.settings, 2);
    finish(oracle);
    CHECK_FALSE(oracle.rmse(0));
    for (const OracleImage image : {kError, kLambda, kAlpha})
        CHECK(largest(readImage(oracle, image, 0)) == 0.0);

    Watched one("tiny", {1, 1});
    one.render(settings);
    one.render(settings);
    oracle.begin(one.renderer, one.moment, one.settings, 2);
    finish(oracle);
    CHECK(oracle.image(kLambdaError, 0)->size() == glm::ivec2(1));
    CHECK(oracle.rmse(0).value() >= 0.0);
}
