// SPDX-License-Identifier: MIT
// Converged references: surfaces of one moment in the light of another, the variance of a sample.

#include "renderer/image/color.h"
#include "renderer/scene/procedural.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/sequence.h"
#include "tests/support/studio.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

using namespace afterglow;
using namespace afterglow::test;

namespace {

constexpr glm::ivec2 kOddSize{61, 37};

double relativeDifference(const glm::vec4& a, const glm::vec4& b) {
    return std::abs(double(luminance(a)) - luminance(b)) / std::max(1e-3f, luminance(b));
}

std::uint32_t instanceOf(const Scene& scene, std::string_view node) {
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (scene.nodes[scene.instances[i].node].name == node)
            return std::uint32_t(i);
    FAIL("no instance at " << std::string(node));
    return 0;
}

} // namespace

TEST_CASE("under other lights a still scene's surfaces are what they are, lit by the others") {
    const GlCheck noGlMessages;
    for (const Signal signal : {Signal::Shadows, Signal::Both}) {
        Studio studio(makeCornell(), kOddSize, signal);
        std::vector<LightState> others = studio.allOn;
        others[0].on = false;
        others[1].tint = {0.5f, 1.0f, 2.0f};
        const FrameInput now = studio.at(0.0), before = studio.at(0.0, others);
        const auto plain = studio.reference(before, 16);
        const auto lit = studio.reference(now, 16);
        const auto emission = studio.targets().surfaces.emission.read<glm::vec4>();
        CHECK(differingPixels(studio.reference(now, before, 16), plain) == 0);
        // The lamp in the picture is that of the moment that is seen.
        CHECK(differingPixels(studio.targets().surfaces.emission.read<glm::vec4>(), emission) == 0);
        CHECK(differingPixels(lit, plain) > 61 * 37 / 2);
    }
}

TEST_CASE("what does not move has, one frame ago, the light that the picture of then shows") {
    const GlCheck noGlMessages;
    Studio studio(makeMoving(), {96, 64});
    const std::uint32_t mover = instanceOf(studio.renderer.scene(), "mover");
    const double then = 0.8, now = 1.17;
    const auto picture = studio.reference(studio.at(then), 64);
    const auto seenThen = studio.visibility();
    const auto today = studio.reference(studio.at(now), 64);
    const auto guides = studio.targets().surfaces.guides.read<glm::vec4>();
    const auto surface = studio.targets().surfaces.surface.read<glm::uvec4>();
    const auto albedo = studio.targets().surfaces.albedo.read<glm::vec4>();
    const auto seenNow = studio.visibility();
    const auto placed = studio.reference(studio.at(now), studio.at(then), 64);

    int compared = 0, different = 0, changed = 0, uncovered = 0;
    for (std::size_t i = 0; i < placed.pixels().size(); ++i) {
        if (seenNow.pixels()[i].x == 0 || seenNow.pixels()[i].x == mover + 1)
            continue;
        if (seenNow.pixels()[i] != seenThen.pixels()[i]) {
            ++uncovered;
            continue;
        }
        ++compared;
        different += placed.pixels()[i] != picture.pixels()[i];
        changed += today.pixels()[i] != picture.pixels()[i];
    }
    MESSAGE(compared, " pixels compared, ", uncovered, " uncovered; light changed on ", changed);
    CHECK(compared > 1500);
    CHECK(different == 0);
    CHECK(changed > 100); // shadow and occlusion of the box
    CHECK(uncovered > 20);
    // The images of the frame are those of now.
    const RenderTargets& t = studio.targets();
    CHECK(differingPixels(t.surfaces.guides.read<glm::vec4>(), guides) == 0);
    CHECK(differingPixels(t.surfaces.surface.read<glm::uvec4>(), surface) == 0);
    CHECK(differingPixels(t.surfaces.albedo.read<glm::vec4>(), albedo) == 0);
    CHECK(differingPixels(studio.visibility(), seenNow) == 0);
    // And the next moment is not disturbed.
    CHECK(differingPixels(studio.reference(studio.at(now), 64), today) == 0);
}

TEST_CASE("what moves has the light of then, where and as it stood then") {
    const GlCheck noGlMessages;
    for (const bool turns : {false, true}) {
        CAPTURE(turns);
        Scene moving = makeMoving();
        const std::uint32_t mover = instanceOf(moving, "mover");
        const std::uint32_t node = moving.instances[mover].node;
        if (turns)
            moving.tracks.push_back(
                {.node = node,
                 .path = Track::Path::Rotation,
                 .interpolation = Track::Interpolation::Linear,
                 .times = {0.0, 2.0},
                 .values = {glm::vec4(0, 0, 0, 1), glm::vec4(0, std::sin(0.4), 0, std::cos(0.4))}});
        Studio studio(moving, {96, 64});
        const Scene& scene = studio.renderer.scene();
        const double then = 0.83, now = 1.17;
        const auto placed = studio.reference(studio.at(now), studio.at(then), 256);
        const auto seenNow = studio.visibility();
        const auto today = studio.reference(studio.at(now), 256);
        // The same view of the body, of then: the camera goes with it.
        const glm::dmat4 thenFromNow =
            glm::dmat4(poseAt(scene, then).worldFromNode[node]) *
            glm::inverse(glm::dmat4(poseAt(scene, now).worldFromNode[node]));
        studio.camera.position = glm::vec3(thenFromNow * glm::dvec4(studio.camera.position, 1.0));
        studio.camera.orientation = glm::normalize(glm::quat(
            glm::quat_cast(glm::dmat3(thenFromNow)) * glm::dquat(studio.camera.orientation)));
        const auto carried = studio.reference(studio.at(then), 256);
        const auto seenCarried = studio.visibility();

        int compared = 0, close = 0, equal = 0;
        double sum = 0.0, sumToday = 0.0;
        for (std::size_t i = 0; i < placed.pixels().size(); ++i) {
            const glm::uvec4 a = seenNow.pixels()[i], b = seenCarried.pixels()[i];
            if (a.x != mover + 1 || b.x != a.x || b.y != a.y)
                continue;
            const double difference = relativeDifference(placed.pixels()[i], carried.pixels()[i]);
            ++compared;
            close += difference < 1e-3;
            equal += placed.pixels()[i] == carried.pixels()[i];
            sum += difference;
            sumToday += relativeDifference(today.pixels()[i], carried.pixels()[i]);
        }
        MESSAGE(compared, " pixels of the mover, ", equal, " equal, ", close,
                " within 0.1 %; mean difference ", sum / compared, ", of the light of now ",
                sumToday / compared);
        CHECK(compared > 90);
        // The rest are samples whose ray passes an edge on the other side: positions are rounded
        // elsewhere, by 1e-7 m, and one of 256 samples is 0.4 %.
        CHECK(close >= 0.95 * compared);
        CHECK(sum / compared < 1e-3);
        CHECK(sumToday / compared > 0.01);
    }
}

TEST_CASE("a lamp that has moved lights the floor from where it was, as the integral says") {
    const GlCheck noGlMessages;
    Scene scene = makeRect();
    const std::uint32_t lamp = scene.instances[scene.lights[0].instances[0]].node;
    scene.tracks.push_back({.node = lamp,
                            .path = Track::Path::Translation,
                            .interpolation = Track::Interpolation::Linear,
                            .times = {0.0, 1.0},
                            .values = {glm::vec4(0.0f), glm::vec4(0.8f, 0.5f, 0.0f, 0.0f)}});
    Studio studio(scene, {33, 21}, Signal::Shadows);
    const auto signal = studio.reference(studio.at(0.0), studio.at(0.5), 1024);
    const auto surface = studio.targets().surfaces.surface.read<glm::uvec4>();
    const auto guides = studio.targets().surfaces.guides.read<glm::vec4>();
    int compared = 0;
    double largest = 0.0, mean = 0.0;
    for (std::size_t i = 0; i < signal.pixels().size(); ++i) {
        if (guides.pixels()[i].w == 0.0f || guides.pixels()[i].y < 0.99f)
            continue;
        const glm::dvec3 point(glm::uintBitsToFloat(glm::uvec3(surface.pixels()[i])));
        // 1 x 1 m of radiance 10 at y = 2.25, its middle at x = 0.4, facing down; see makeRect().
        constexpr int kSteps = 32;
        double irradiance = 0.0;
        for (int x = 0; x < kSteps; ++x)
            for (int z = 0; z < kSteps; ++z) {
                const glm::dvec3 to =
                    glm::dvec3(0.4 - 0.5 + (x + 0.5) / kSteps, 2.25, -0.5 + (z + 0.5) / kSteps) -
                    point;
                const double squared = glm::dot(to, to);
                irradiance += 10.0 * to.y * to.y / (squared * squared) / (kSteps * kSteps);
            }
        if (irradiance < 0.01)
            continue;
        const double error = double(signal.pixels()[i].g) * M_PI / irradiance - 1.0;
        largest = std::max(largest, std::abs(error));
        mean += error;
        ++compared;
    }
    MESSAGE(compared, " points, largest relative error ", largest, ", mean ", mean / compared);
    CHECK(compared > 300);
    CHECK(largest < 0.03);                   // noise of 1024 samples
    CHECK(std::abs(mean / compared) < 1e-3); // no bias
}

TEST_CASE(
    "a reference is the mean of the frames of the same numbers, and its alpha their variance") {
    const GlCheck noGlMessages;
    constexpr int kFrames = 48;
    Studio studio(makeCornell(), kOddSize);
    std::vector<glm::dvec3> sum(61 * 37);
    std::vector<double> l(sum.size()), squares(sum.size());
    for (int frame = 0; frame < kFrames; ++frame) {
        FrameInput input = studio.at(0.0);
        input.frame = std::uint32_t(frame);
        studio.renderer.render(input, studio.settings);
        const auto raw = studio.targets().signals[0].raw.current().read<glm::vec4>();
        for (std::size_t i = 0; i < sum.size(); ++i) {
            sum[i] += glm::dvec3(raw.pixels()[i]);
            l[i] += raw.pixels()[i].a;
            squares[i] += double(raw.pixels()[i].a) * raw.pixels()[i].a;
        }
    }
    const auto reference = studio.reference(studio.at(0.0), kFrames);
    double largest = 0.0, largestVariance = 0.0, variances = 0.0;
    for (std::size_t i = 0; i < sum.size(); ++i) {
        const double mean = l[i] / kFrames, second = squares[i] / kFrames;
        const double scale = std::max(1e-6, second);
        largest = std::max(
            largest, glm::distance(sum[i] / double(kFrames), glm::dvec3(reference.pixels()[i])) /
                         std::sqrt(scale));
        largestVariance =
            std::max(largestVariance,
                     std::abs(second - mean * mean - double(reference.pixels()[i].a)) / scale);
        variances += second - mean * mean;
    }
    MESSAGE("largest error of the mean ", largest, ", of the variance ", largestVariance,
            " of the second moment");
    CHECK(largest < 5e-7);
    CHECK(largestVariance < 1e-6); // the difference of two numbers with 24 bits each
    CHECK(variances / double(sum.size()) > 0.01);
}

TEST_CASE("thousands of samples are summed without loss") {
    const GlCheck noGlMessages;
    constexpr int kSamples = 4096;
    Studio studio(makeTiny(), {8, 5});
    std::vector<double> exact(8 * 5);
    std::vector<float> plain(exact.size());
    studio.renderer.beginReference(studio.at(0.0), studio.settings);
    for (int k = 0; k < kSamples; ++k) {
        studio.renderer.addReferenceSamples(1);
        const auto raw = studio.targets().signals[0].raw.current().read<glm::vec4>();
        for (std::size_t i = 0; i < exact.size(); ++i) {
            exact[i] += raw.pixels()[i].g;
            plain[i] += raw.pixels()[i].g;
        }
    }
    studio.renderer.finishReference();
    const auto mean = studio.renderer.filteredSignal().read<glm::vec4>();
    double compensated = 0.0, uncompensated = 0.0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        if (exact[i] == 0.0)
            continue;
        const double truth = exact[i] / kSamples;
        compensated = std::max(compensated, std::abs(mean.pixels()[i].g / truth - 1.0));
        uncompensated =
            std::max(uncompensated, std::abs(double(plain[i]) / kSamples / truth - 1.0));
    }
    MESSAGE("largest relative error ", compensated, "; of a plain sum ", uncompensated);
    CHECK(compensated < 1.3e-7); // one rounding of the sum and one of the product
    CHECK(uncompensated > 5e-7); // what is measured here
}
