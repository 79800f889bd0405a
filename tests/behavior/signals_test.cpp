// SPDX-License-Identifier: MIT
// Light that is filtered in parts: each signal has its own noise, gradient, filter and reference.

#include "renderer/image/color.h"
#include "renderer/scene/procedural.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/sequence.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace afterglow;
using namespace afterglow::test;

namespace {

constexpr glm::ivec2 kSize{61, 37};

Image<glm::vec4> rawOf(const Sequence& sequence, std::size_t signal) {
    return sequence.targets().signals.at(signal).raw.current().read<glm::vec4>();
}

Image<float> lambdaOf(const Sequence& sequence, std::size_t signal) {
    return imageOf(sequence.targets(), svgf::kLambda, 0, signal).read<float>();
}

std::ptrdiff_t countOf(const Image<float>& image, float value) {
    return std::ranges::count(image.pixels(), value);
}

} // namespace

TEST_CASE("the parts of the light are those of each kind of ray, and add up to the whole") {
    const GlCheck noGlMessages;
    const auto rendered = [](Signal signal) {
        Settings settings = settingsOf(Filter::Svgf, signal);
        settings.lighting.signalClamp = 1e4f; // beside a lamp the bound would be reached
        return Sequence(makeProceduralScene("hall"), kSize, settings);
    };
    Sequence apart = rendered(Signal::Separate), whole = rendered(Signal::Both),
             shadows = rendered(Signal::Shadows), ao = rendered(Signal::AmbientOcclusion);
    for (Sequence* each : {&apart, &whole, &shadows, &ao})
        each->run(3);
    CHECK(differingPixels(rawOf(apart, 0), rawOf(shadows, 0)) == 0);
    CHECK(differingPixels(rawOf(apart, 1), rawOf(ao, 0)) == 0);
    // Neither filter knows of the other signal.
    CHECK(differingPixels(apart.renderer().filteredSignal(0, 0).read<glm::vec4>(),
                          shadows.signal()) == 0);
    CHECK(differingPixels(apart.renderer().filteredSignal(0, 1).read<glm::vec4>(), ao.signal()) ==
          0);
    const auto a = rawOf(apart, 0), b = rawOf(apart, 1), both = rawOf(whole, 0);
    double largest = 0.0, most = 0.0;
    for (std::size_t i = 0; i < both.pixels().size(); ++i) {
        const glm::dvec3 sum = glm::dvec3(a.pixels()[i]) + glm::dvec3(b.pixels()[i]);
        const glm::dvec3 off = glm::abs(sum - glm::dvec3(both.pixels()[i]));
        largest = std::max({largest, off.x, off.y, off.z});
        most = std::max(most, sum.x);
    }
    CHECK(largest <= 1e-6 * most); // one rounding
    CHECK(most > 1.0);
}

TEST_CASE("a light that goes out is a change of the shadows alone, and found to be a whole one") {
    const GlCheck noGlMessages;
    for (const auto placement : {SamplePlacement::Merged, SamplePlacement::Extra}) {
        CAPTURE(int(placement));
        Settings settings = settingsOf(Filter::Asvgf, Signal::Separate);
        settings.lighting.gradientSamples = int(placement);
        Sequence apart(makeProceduralScene("cornell"), kSize, settings);
        settings.lighting.signal = int(Signal::Both);
        Sequence whole(makeProceduralScene("cornell"), kSize, settings);
        for (Sequence* each : {&apart, &whole}) {
            each->run(5);
            for (LightState& light : each->lights)
                light.on = false;
            each->next();
        }
        const Image<float> ofAo = lambdaOf(apart, 1);
        CHECK(countOf(ofAo, 0.0f) == std::ptrdiff_t(ofAo.pixels().size()));
        CHECK(countOf(lambdaOf(apart, 0), 1.0f) > 100); // of 273, some of which are dark
        CHECK(countOf(lambdaOf(whole, 0), 1.0f) == 0);  // the surroundings are still there
    }
}

TEST_CASE("where nothing changes no signal has a gradient, and A-SVGF is SVGF in each") {
    const GlCheck noGlMessages;
    Settings settings = settingsOf(Filter::Asvgf, Signal::Separate);
    settings.lighting.gradientSamples = int(SamplePlacement::Extra);
    Sequence adaptive(makeProceduralScene("rooms"), kSize, settings);
    Sequence plain(makeProceduralScene("rooms"), kSize, settingsOf(Filter::Svgf, Signal::Separate));
    for (int i = 0; i < 6; ++i) {
        adaptive.next();
        plain.next();
        for (std::size_t signal = 0; signal < 2; ++signal) {
            const Image<float> lambda = lambdaOf(adaptive, signal);
            REQUIRE(countOf(lambda, 0.0f) == std::ptrdiff_t(lambda.pixels().size()));
            CHECK(differingPixels(adaptive.renderer().filteredSignal(0, signal).read<glm::vec4>(),
                                  plain.renderer().filteredSignal(0, signal).read<glm::vec4>()) ==
                  0);
        }
    }
}

TEST_CASE("each signal converges to the reference of its own kind of ray, bit for bit") {
    const GlCheck noGlMessages;
    const auto converge = [](Signal signal) {
        Sequence sequence(makeProceduralScene("cornell"), kSize, settingsOf(Filter::None, signal));
        sequence.next();
        sequence.reference(9);
        std::vector<Image<glm::vec4>> images;
        for (std::size_t i = 0; i < sequence.renderer().signals().size(); ++i)
            images.push_back(sequence.renderer().filteredSignal(0, i).read<glm::vec4>());
        return images;
    };
    const auto apart = converge(Signal::Separate);
    REQUIRE(apart.size() == 2);
    CHECK(differingPixels(apart[0], converge(Signal::Shadows)[0]) == 0);
    CHECK(differingPixels(apart[1], converge(Signal::AmbientOcclusion)[0]) == 0);
    CHECK(differingPixels(apart[0], apart[1]) > 1000);
}

TEST_CASE("the light can be divided anew between two frames") {
    const GlCheck noGlMessages;
    Sequence sequence(makeProceduralScene("cornell"), kSize, settingsOf(Filter::Asvgf));
    sequence.run(4);
    for (const Signal signal : {Signal::Separate, Signal::Both, Signal::Separate}) {
        sequence.settings.lighting.signal = int(signal);
        sequence.run(2);
        CHECK(sequence.renderer().signals().size() == signalsOf(signal).size());
        CHECK(sequence.renderer().readStats().invalidValues == 0);
    }
    // A new signal starts without a history.
    const auto moments = imageOf(sequence.targets(), svgf::kMoments, 0, 1).read<glm::vec4>();
    for (const glm::vec4& pixel : moments.pixels())
        CHECK(pixel.z <= 2.0f);
}

TEST_CASE("a division of the light leaves nothing behind for the next one") {
    const GlCheck noGlMessages;
    const auto rendered = [](Signal first) {
        Sequence sequence(makeProceduralScene("gallery"), kSize, settingsOf(Filter::Svgf, first));
        const Camera start = sequence.camera;
        for (int frame = 0; frame < 6; ++frame) {
            sequence.camera = start;
            sequence.camera.position.x += 0.04f * float(frame); // over the polished floor
            if (frame == 2) {
                sequence.settings.lighting.signal = int(Signal::Separate);
                sequence.renderer().resetHistory();
            }
            sequence.next();
        }
        return sequence;
    };
    const Sequence from = rendered(Signal::Split), always = rendered(Signal::Separate);
    for (const std::size_t signal : {0, 1})
        CHECK(differingPixels(rawOf(from, signal), rawOf(always, signal)) == 0);
    const auto accumulated = [](const Sequence& of) {
        return imageOf(of.targets(), svgf::kMoments, 0, 1).read<glm::vec4>();
    };
    CHECK(differingPixels(accumulated(from), accumulated(always)) == 0);
    CHECK(from.targets().bytes() == always.targets().bytes());
}
