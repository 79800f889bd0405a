// SPDX-License-Identifier: MIT
// The change of light by channel: gradient samples, their reconstruction, and what it says.

#include <doctest/doctest.h>

#include <utility>

#include "tests/stage/counted.h"
#include "tests/support/compare.h"
#include "tests/support/gl_fixture.h"

using namespace afterglow;
using namespace afterglow::test;

namespace {

// Sums of nine, and scalar products, at most.
constexpr Tolerance kTolerance{.max = 2e-6, .relative = 2e-6};
// As in gradient_stage_test.cpp.
constexpr Tolerance kFilterTolerance{.max = 3e-5, .relative = 3e-5};
// Differences of means of squares, and k, a quotient of such differences.
constexpr Tolerance kChangeTolerance{.max = 3e-5, .relative = 3e-5};
// Far above what 32 bits lose in a sum of nine.
constexpr double kLeastMargin = 1.5e-6;

/// Returns the largest difference of all three images.
double checkPairs(const LightPairImages& actual, const reference::LightPairs& expected,
                  Tolerance tolerance) {
    CHECK_CLOSE(actual.before, expected.before, tolerance);
    CHECK_CLOSE(actual.now, expected.now, tolerance);
    CHECK_CLOSE(actual.products, expected.products, tolerance);
    return std::max({compare(actual.before, expected.before, tolerance).largest,
                     compare(actual.now, expected.now, tolerance).largest,
                     compare(actual.products, expected.products, tolerance).largest});
}

reference::GradientInputs inputsOf(const RandomFrame& frame) {
    return {frame.raw, frame.previousRaw, frame.samples, frame.guides};
}

/// Gives each sample of the frame before the light that it has in this one, times a factor.
void lightBefore(RandomFrame& frame, float factor) {
    for (int y = 0; y < frame.strata.y; ++y)
        for (int x = 0; x < frame.strata.x; ++x)
            if (const glm::uvec4 sample = frame.samples({x, y}); sample.y != 0) {
                const glm::ivec2 source(int(sample.z & 0xffffu), int(sample.z >> 16));
                frame.previousRaw(source) =
                    factor * frame.raw(reference::landingOf(frame.samples, {x, y}));
            }
}

/// Runs a whole reconstruction of five iterations on the device.
ChangeOfLight reconstructed(RandomFrame& frame, const gpu::ChangeParams& params) {
    LightPairImages pairs = runLightPairs(testShaders(), frame);
    frame.changed = pairs.changed;
    for (const int step : {1, 2, 4, 8, 16}) {
        frame.before = pairs.before;
        frame.now = pairs.now;
        frame.products = pairs.products;
        pairs =
            runLightPairsAtrous(testShaders(), frame, Kernel::Box3x3, {4.0f, 128.0f, 1.0f, step});
    }
    frame.before = pairs.before;
    frame.now = pairs.now;
    frame.products = pairs.products;
    return runChange(testShaders(), frame, params);
}

} // namespace

TEST_CASE("light pairs hold the samples of both frames by channel, at every size") {
    double largest = 0.0;
    std::uint32_t changed = 0;
    for (const glm::ivec2 size : kStageSizes)
        for (const std::uint32_t seed : {7u, 8u, 9u, 10u}) {
            CAPTURE(size.x);
            CAPTURE(size.y);
            CAPTURE(seed);
            const RandomFrame frame(size, seed);
            const LightPairImages pairs = runLightPairs(testShaders(), frame);
            const reference::LightPairs expected = reference::lightPairs(inputsOf(frame));
            CHECK(expected.margin.least() > kLeastMargin);
            CHECK(pairs.changed == expected.changed);
            largest = std::max(largest, checkPairs(pairs, expected, kTolerance));
            changed += pairs.changed;
        }
    CHECK(changed > 200);
    MESSAGE("largest difference: ", largest);
}

TEST_CASE("light of samples beside the picture is read there, one texel a stratum") {
    for (const std::uint32_t seed : {7u, 8u}) {
        const RandomFrame frame({61, 37}, seed);
        Image<glm::vec4> beside(frame.strata, glm::vec4(90.0f)); // garbage where there is no sample
        for (int y = 0; y < frame.strata.y; ++y)
            for (int x = 0; x < frame.strata.x; ++x)
                if (frame.samples({x, y}).y != 0)
                    beside({x, y}) = frame.raw({3 * x, 3 * y});
        const LightPairImages pairs = runLightPairs(testShaders(), frame, &beside);
        const auto expected = reference::lightPairs(inputsOf(frame), &beside);
        CHECK(expected.margin.least() > kLeastMargin);
        CHECK(pairs.changed == expected.changed);
        checkPairs(pairs, expected, kTolerance);
    }
}

TEST_CASE("an a-trous iteration over light pairs follows the text, at every size, step, kernel") {
    double largest = 0.0;
    for (const glm::ivec2 size : kStageSizes)
        for (const std::uint32_t seed : {7u, 8u})
            for (const Kernel kernel : {Kernel::B3Spline5x5, Kernel::Box3x3})
                for (const int step : {1, 3, 4})
                    for (const auto& [sigmaLuminance, sigmaDepth] :
                         {std::pair(4.0f, 1.0f), {4.0f, 20.0f}, {0.0f, 1.0f}}) {
                        CAPTURE(size.x);
                        CAPTURE(size.y);
                        CAPTURE(seed);
                        CAPTURE(int(kernel));
                        CAPTURE(step);
                        CAPTURE(sigmaLuminance);
                        CAPTURE(sigmaDepth);
                        const RandomFrame frame(size, seed);
                        const gpu::EdgeStopping params{sigmaLuminance, 128.0f, sigmaDepth, step};
                        largest = std::max(
                            largest,
                            checkPairs(runLightPairsAtrous(testShaders(), frame, kernel, params),
                                       reference::lightPairsAtrous(
                                           {frame.before, frame.now, frame.products},
                                           frame.strataGuides, frame.strataSlope, kernel, params),
                                       kFilterTolerance));
                    }
    MESSAGE("largest difference: ", largest);
}

TEST_CASE("the change of light follows the text, for every choice") {
    double largest = 0.0;
    int scaled = 0, equal = 0, still = 0, whole = 0;
    for (const glm::ivec2 size : kStageSizes)
        for (const std::uint32_t seed : {7u, 8u, 9u})
            for (const gpu::ChangeParams& params : kChanges) {
                CAPTURE(size.x);
                CAPTURE(size.y);
                CAPTURE(seed);
                CAPTURE(params.over);
                CAPTURE(params.deltaFloor);
                CAPTURE(params.forceLambda);
                CAPTURE(params.scaleHistory);
                CAPTURE(params.scaleDoubt);
                const RandomFrame frame(size, seed);
                const ChangeOfLight found = runChange(testShaders(), frame, params);
                const auto expected =
                    reference::change({frame.before, frame.now, frame.products}, params);
                CHECK(expected.margin.least() > kLeastMargin);
                CHECK_CLOSE(found.lambda, expected.lambda, kChangeTolerance);
                CHECK_CLOSE(found.change, expected.change, kChangeTolerance);
                largest = std::max(
                    {largest, compare(found.lambda, expected.lambda, kChangeTolerance).largest,
                     compare(found.change, expected.change, kChangeTolerance).largest});
                for (std::size_t i = 0; i < expected.change.pixels().size(); ++i) {
                    const bool isOne = expected.change.pixels()[i].z == 1.0;
                    const double lambda = expected.lambda.pixels()[i];
                    CHECK((found.change.pixels()[i].z == 1.0f || !isOne));
                    ++(isOne ? equal : scaled);
                    still += lambda == 0.0;
                    whole += lambda == 1.0;
                }
            }
    CHECK(scaled > 500);
    CHECK(equal > 500);
    CHECK(still > 500);
    CHECK(whole > 100);
    MESSAGE("largest difference: ", largest);
}

TEST_CASE("without a change lambda and E are 0 and the factor is 1, bit for bit") {
    for (const std::uint32_t seed : {7u, 8u})
        for (const gpu::ChangeParams& params : kChanges) {
            if (params.forceLambda >= 0.0f)
                continue;
            RandomFrame frame({61, 37}, seed);
            lightBefore(frame, 1.0f);
            const ChangeOfLight found = reconstructed(frame, params);
            CHECK(frame.changed == 0);
            int lit = 0;
            for (std::size_t i = 0; i < found.change.pixels().size(); ++i) {
                CHECK(found.lambda.pixels()[i] == 0.0f);
                CHECK(found.change.pixels()[i].x == 0.0f);
                CHECK(found.change.pixels()[i].z == 1.0f);
                lit += found.change.pixels()[i].w > 0.0f;
            }
            CHECK(lit > 100); // there was light to compare
        }
}

TEST_CASE("light that is dimmed to a half everywhere is explained by that factor alone") {
    for (const std::uint32_t seed : {7u, 8u}) {
        RandomFrame frame({61, 37}, seed);
        lightBefore(frame, 2.0f);
        const gpu::ChangeParams params = kChanges[0];
        const ChangeOfLight found = reconstructed(frame, params);
        int lit = 0;
        for (std::size_t i = 0; i < found.change.pixels().size(); ++i) {
            const glm::vec4 change = found.change.pixels()[i];
            if (change.w < 0.1f)
                continue;
            ++lit;
            CHECK(found.lambda.pixels()[i] < 0.5f); // over max(A, B) + 0.02 m
            CHECK(found.lambda.pixels()[i] > 0.45f);
            CHECK(change.z == doctest::Approx(0.5).epsilon(1e-3));
            CHECK(change.x < 1e-5f);
        }
        CHECK(lit > 100);
        CHECK(frame.changed > 100);
    }
}
