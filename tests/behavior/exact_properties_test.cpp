// SPDX-License-Identifier: MIT
// What must hold whatever the noise. Each case is one promise of the method: Schied et al. 2018.

#include "renderer/pipeline/aov.h"
#include "renderer/scene/procedural.h"
#include "tests/behavior/comparisons.h"
#include "tests/support/gl_fixture.h"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>

using namespace afterglow;
using namespace afterglow::test;

namespace {

constexpr glm::ivec2 kOddSize{61, 37};

int strataWithSample(const Sequence& sequence) {
    int count = 0;
    const auto image = sequence.targets().samples.read<glm::uvec4>();
    for (const glm::uvec4& sample : image.pixels())
        count += sample.y != 0u;
    return count;
}

float largestLambda(const Sequence& sequence) {
    float largest = 0.0f;
    const auto image = imageOf(sequence.targets(), svgf::kLambda).read<float>();
    for (const float lambda : image.pixels())
        largest = std::max(largest, lambda);
    return largest;
}

/// The largest |delta| / Delta over all gradient samples.
float largestChange(const Sequence& sequence) {
    float largest = 0.0f;
    const auto image = imageOf(sequence.targets(), svgf::kGradientSamples).read<glm::vec4>();
    for (const glm::vec4& g : image.pixels())
        if (g.x != 0.0f)
            largest = std::max(largest, std::abs(g.x) / g.y);
    return largest;
}

/// SVGF on the raw frames that A-SVGF makes: gradient samples are merged, but not used.
Settings svgfOnMergedFrames(Signal signal = Signal::Both) {
    Settings settings = settingsOf(Filter::Svgf, signal);
    settings.denoiser.alwaysCarrySamples = 1;
    return settings;
}

/// A whole scene, with its occluders and lights, under one node that glides and turns.
Scene oneMovingBody(std::string_view name) {
    Scene scene = makeProceduralScene(name);
    Node carrier;
    carrier.name = "carrier";
    for (Node& node : scene.nodes)
        node.parent = node.parent < 0 ? 0 : node.parent + 1;
    scene.nodes.insert(scene.nodes.begin(), carrier);
    for (Instance& instance : scene.instances)
        ++instance.node;
    for (Track& track : scene.tracks)
        ++track.node;
    for (SceneCamera& camera : scene.cameras)
        ++camera.node;
    const float angle = 0.6f;
    scene.tracks = {
        Track{.node = 0,
              .path = Track::Path::Translation,
              .interpolation = Track::Interpolation::Linear,
              .times = {0.0, 1.0},
              .values = {glm::vec4(0.0f), glm::vec4(0.7f, 0.2f, 0.3f, 0.0f)}},
        Track{.node = 0,
              .path = Track::Path::Rotation,
              .interpolation = Track::Interpolation::Linear,
              .times = {0.0, 1.0},
              .values = {glm::vec4(0.0f, 0.0f, 0.0f, 1.0f),
                         glm::vec4(0.0f, std::sin(angle / 2.0f), 0.0f, std::cos(angle / 2.0f))}}};
    return scene;
}

} // namespace

TEST_CASE("in a scene where nothing changes every gradient sample is 0 and A-SVGF is SVGF") {
    const GlCheck noGlMessages;
    for (const char* scene : {"cornell", "hall"}) {
        CAPTURE(scene);
        Sequence adaptive(makeProceduralScene(scene), kOddSize, settingsOf(Filter::Asvgf));
        Sequence plain(makeProceduralScene(scene), kOddSize, svgfOnMergedFrames());
        for (int i = 0; i < 12; ++i) {
            const std::uint32_t frame = adaptive.next();
            plain.next();
            CAPTURE(frame);
            if (frame > 0)
                CHECK(strataWithSample(adaptive) > 100); // of 21 x 13
            const auto image =
                imageOf(adaptive.targets(), svgf::kGradientSamples).read<glm::vec4>();
            for (const glm::vec4& g : image.pixels())
                REQUIRE(g.x == 0.0f);
            CHECK(largestLambda(adaptive) == 0.0f);
            checkEqualOutputs(adaptive, plain);
        }
        CHECK(adaptive.renderer().readStats().invalidValues == 0);
    }
}

TEST_CASE("a moving camera makes no gradient on diffuse surfaces") {
    const GlCheck noGlMessages;
    Sequence sequence(makeProceduralScene("hall"), kOddSize, settingsOf(Filter::Asvgf));
    const Camera start = sequence.camera;
    int samples = 0;
    float largest = 0.0f;
    for (int i = 0; i < 16; ++i) {
        const float t = float(i);
        sequence.camera.position =
            start.position + 0.05f * t * start.forward() + glm::vec3(0.02f * t, 0.0f, 0.0f);
        sequence.camera.orientation =
            glm::normalize(glm::angleAxis(0.01f * t, glm::vec3(0, 1, 0)) * start.orientation);
        sequence.next();
        samples += strataWithSample(sequence);
        largest = std::max(largest, largestChange(sequence));
    }
    MESSAGE(samples, " gradient samples, largest |delta| / Delta ", largest);
    CHECK(samples > 1500);
    CHECK(largest <= 1e-4f);
}

TEST_CASE("a body that moves with its own light has no gradient") {
    const GlCheck noGlMessages;
    for (const char* scene : {"tiny", "cornell"}) {
        Sequence sequence(oneMovingBody(scene), kOddSize, settingsOf(Filter::Asvgf));
        sequence.secondsPerFrame = 1.0 / 30.0;
        int samples = 0;
        float largest = 0.0f;
        for (int i = 0; i < 20; ++i) {
            sequence.next();
            samples += strataWithSample(sequence);
            largest = std::max(largest, largestChange(sequence));
        }
        MESSAGE(std::string(scene), ": ", samples, " gradient samples, largest |delta| / Delta ",
                largest);
        CHECK(samples > 1500);
        CHECK(largest <= 1e-4f);
    }
}

TEST_CASE("a light that is toggled behind a wall leaves lambda at 0 in the room it never lit") {
    const GlCheck noGlMessages;
    for (const char* scene : {"rooms", "hall"}) {
        CAPTURE(scene);
        Sequence sequence(makeProceduralScene(scene), kOddSize, settingsOf(Filter::Asvgf));
        for (int i = 0; i < 12; ++i) {
            sequence.light("behind wall").on = (i / 3) % 2 == 0;
            sequence.next();
            CHECK(largestLambda(sequence) == 0.0f);
        }
        CHECK(strataWithSample(sequence) > 100);
    }
}

TEST_CASE("the only light, switched off and on again, gives lambda 1 in the frame of the event") {
    const GlCheck noGlMessages;
    Sequence sequence(makeProceduralScene("cornell"), {96, 64},
                      settingsOf(Filter::Asvgf, Signal::Shadows));
    sequence.allLightsOffBut("key");
    const Image<glm::vec4> lit = sequence.reference(64);
    sequence.run(6);
    for (const bool on : {false, true, false}) {
        CAPTURE(on);
        sequence.light("key").on = on;
        sequence.next();
        const Image<glm::vec4> gradient =
            imageOf(sequence.targets(), svgf::kGradient0).read<glm::vec4>();
        const Image<float> lambda = imageOf(sequence.targets(), svgf::kLambda).read<float>();
        const Image<glm::vec4> control =
            imageOf(sequence.targets(), svgf::kControl).read<glm::vec4>();
        int changed = 0;
        for (std::size_t i = 0; i < lambda.pixels().size(); ++i)
            if (gradient.pixels()[i].y > sequence.settings.denoiser.gradient.deltaFloor) {
                ++changed;
                REQUIRE(lambda.pixels()[i] == doctest::Approx(1.0).epsilon(1e-6));
            }
        int litPixels = 0, caught = 0;
        for (std::size_t i = 0; i < lit.pixels().size(); ++i)
            if (lit.pixels()[i].g > 0.05f) {
                ++litPixels;
                caught += control.pixels()[i].x > 0.999f;
            }
        MESSAGE(changed, " strata changed; lambda is 1 at ", caught, " of ", litPixels,
                " lit pixels");
        CHECK(litPixels > 96 * 64 / 3);
        // What is left over: pixels on thin surfaces none of whose neighbors held a sample.
        CHECK(caught >= 0.995 * litPixels);
        sequence.run(6);
    }
}

TEST_CASE("the same frames come out twice, bit for bit, in every image") {
    const GlCheck noGlMessages;
    for (const Filter filter : allFilters()) {
        CAPTURE(std::string(nameOf(filter)));
        std::vector<std::unique_ptr<Sequence>> runs;
        for (int run = 0; run < 2; ++run) {
            auto sequence = std::make_unique<Sequence>(makeProceduralScene("hall"), kOddSize,
                                                       settingsOf(filter));
            sequence->secondsPerFrame = 1.0 / 30.0;
            for (int i = 0; i < 6; ++i) {
                sequence->light("key").on = i < 3;
                sequence->camera.position.x += 0.01f;
                sequence->next();
            }
            runs.push_back(std::move(sequence));
        }
        const RenderTargets& a = runs[0]->targets();
        const RenderTargets& b = runs[1]->targets();
        CHECK(differingPixels(a.surfaces.visibility.read<glm::uvec4>(),
                              b.surfaces.visibility.read<glm::uvec4>()) == 0);
        CHECK(differingPixels(a.seeds.current().read<std::uint32_t>(),
                              b.seeds.current().read<std::uint32_t>()) == 0);
        CHECK(differingPixels(a.samples.read<glm::uvec4>(), b.samples.read<glm::uvec4>()) == 0);
        for (const AovInfo& aov : aovs())
            if (isMadeBy(aov, settingsOf(filter)))
                CHECK(differingPixels(readAov(runs[0]->renderer(), aov),
                                      readAov(runs[1]->renderer(), aov)) == 0);
        CHECK(differingPixels(runs[0]->renderer().display().read<glm::u8vec4>(),
                              runs[1]->renderer().display().read<glm::u8vec4>()) == 0);
        checkEqualOutputs(*runs[0], *runs[1]);
    }
}

TEST_CASE("another seed gives another picture of the same mean") {
    const GlCheck noGlMessages;
    Settings settings = settingsOf(Filter::None, Signal::Shadows);
    Sequence a(makeProceduralScene("cornell"), kOddSize, settings),
        b(makeProceduralScene("cornell"), kOddSize, settings);
    b.seed = 2;
    a.next();
    b.next();
    CHECK(differingPixels(a.signal(), b.signal()) > 61 * 37 / 3);
    const Image<glm::vec4> meanA = a.reference(256), meanB = b.reference(256);
    double sumA = 0.0, sumB = 0.0;
    for (std::size_t i = 0; i < meanA.pixels().size(); ++i) {
        sumA += meanA.pixels()[i].g;
        sumB += meanB.pixels()[i].g;
    }
    CHECK(sumA == doctest::Approx(sumB).epsilon(0.002)); // 256 samples in each of 2,257 pixels
}

TEST_CASE("with lambda forced to 1 no previous frame is left in the output") {
    const GlCheck noGlMessages;
    Settings forced = settingsOf(Filter::Asvgf);
    forced.denoiser.gradient.forceLambda = 1.0f;
    // Another past under the same lights of today.
    Sequence bright(makeProceduralScene("cornell"), kOddSize, forced),
        dark(makeProceduralScene("cornell"), kOddSize, forced);
    for (LightState& state : dark.lights)
        state.on = false;
    bright.run(5);
    dark.run(5);
    CHECK(differingPixels(bright.signal(), dark.signal()) > 61 * 37 / 2);
    for (LightState& state : dark.lights)
        state.on = true;
    bright.next();
    dark.next();
    // But for the luminance of what was fetched, which is kept beside the color to be looked at.
    const auto colorOf = [](const Sequence& sequence) {
        Image<glm::vec4> color = imageOf(sequence.targets(), svgf::kColor).read<glm::vec4>();
        for (glm::vec4& pixel : color.pixels())
            pixel.a = 0.0f;
        return color;
    };
    CHECK(differingPixels(colorOf(bright), colorOf(dark)) == 0);
    CHECK(differingPixels(imageOf(bright.targets(), svgf::kMoments).read<glm::vec4>(),
                          imageOf(dark.targets(), svgf::kMoments).read<glm::vec4>()) == 0);
    CHECK(differingPixels(bright.signal(), dark.signal()) == 0);
}

TEST_CASE("with lambda forced to 0 A-SVGF is SVGF, whatever happens to the lights") {
    const GlCheck noGlMessages;
    Settings forced = settingsOf(Filter::Asvgf);
    forced.denoiser.gradient.forceLambda = 0.0f;
    Sequence adaptive(makeProceduralScene("cornell"), kOddSize, forced);
    Sequence plain(makeProceduralScene("cornell"), kOddSize, svgfOnMergedFrames());
    for (int i = 0; i < 8; ++i) {
        for (Sequence* sequence : {&adaptive, &plain}) {
            sequence->light("key").on = i != 3 && i != 4;
            sequence->camera.position.x += 0.01f;
            sequence->next();
        }
        checkEqualOutputs(adaptive, plain);
    }
}

TEST_CASE("every size works, down to a single pixel") {
    const GlCheck noGlMessages;
    for (const glm::ivec2 size :
         {glm::ivec2(1, 1), {2, 1}, {1, 5}, {3, 3}, {4, 7}, {10, 9}, {61, 37}, {67, 2}}) {
        for (const Filter filter : allFilters()) {
            CAPTURE(size.x);
            CAPTURE(size.y);
            CAPTURE(std::string(nameOf(filter)));
            Sequence sequence(makeProceduralScene("tiny"), size, settingsOf(filter));
            for (int i = 0; i < 4; ++i) {
                sequence.camera.position.x += 0.02f;
                sequence.light("key").on = i != 2;
                sequence.next();
            }
            CHECK(sequence.renderer().readStats().invalidValues == 0);
            const auto image = sequence.signal();
            for (const glm::vec4& pixel : image.pixels())
                REQUIRE(
                    (std::isfinite(pixel.r) && std::isfinite(pixel.g) && std::isfinite(pixel.b)));
        }
    }
}

TEST_CASE("a gradient sample is never carried on for a second time") {
    const GlCheck noGlMessages;
    Sequence sequence(makeProceduralScene("cornell"), kOddSize, settingsOf(Filter::Asvgf));
    for (int i = 0; i < 10; ++i) {
        const std::uint32_t frame = sequence.next();
        int carried = 0;
        const auto image = sequence.targets().seeds.current().read<std::uint32_t>();
        for (const std::uint32_t seed : image.pixels()) {
            const std::uint32_t age =
                frame - (seed >> 14); // the frame number is above the tile's 14 bits
            REQUIRE(age <= 1u);
            carried += age == 1u;
        }
        CHECK(carried == strataWithSample(sequence));
        CHECK(std::uint32_t(carried) == sequence.renderer().readStats().gradientSamples);
    }
}
