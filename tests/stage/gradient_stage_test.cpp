// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <utility>

#include "tests/reference/gradient.h"
#include "tests/stage/stage_runner.h"
#include "tests/support/compare.h"
#include "tests/support/gl_fixture.h"

using namespace afterglow;
using namespace afterglow::test;

namespace {

// Sums of nine at most. llvmpipe: 3e-7.
constexpr Tolerance kTolerance{.max = 2e-6, .relative = 2e-6};
// llvmpipe: 7e-6, where little variance makes the luminance weight steep; the rest is for pow() and
// exp() on GPUs.
constexpr Tolerance kFilterTolerance{.max = 3e-5, .relative = 3e-5};
constexpr Tolerance kExact{};

} // namespace

TEST_CASE("gradient samples and the guides of strata follow the paper, at every size") {
    double largest = 0.0;
    for (const glm::ivec2 size : kStageSizes)
        for (const std::uint32_t seed : {7u, 8u, 9u, 10u}) {
            CAPTURE(size.x);
            CAPTURE(size.y);
            CAPTURE(seed);
            const RandomFrame frame(size, seed);
            const gpu::GradientParams params{
                1e-4f, -1.0f, seed % 2 == 0 ? gpu::kGradientSigned : gpu::kGradientAbsolute, 0.0f};
            const auto gradient = runGradient(testShaders(), frame, params);
            const auto expected = reference::gradient(
                {frame.raw, frame.previousRaw, frame.samples, frame.guides}, params);
            CHECK_CLOSE(gradient, expected, kTolerance);
            const auto strata = runStrata(testShaders(), frame);
            const auto guides = reference::strataGuides(frame.guides, frame.slope);
            CHECK_CLOSE(strata.guides, guides.guides, kExact);
            CHECK_CLOSE(strata.slope, guides.slope, kExact);
            largest = std::max(largest, compare(gradient, expected, kTolerance).largest);
        }
    MESSAGE("largest difference: ", largest);
}

TEST_CASE("a sample that did not change has no gradient, bit for bit") {
    const RandomFrame frame({61, 37}, 7);
    const auto gradient =
        runGradient(testShaders(), frame, {1e-4f, -1.0f, gpu::kGradientSigned, 0.0f});
    int still = 0, changed = 0;
    for (int y = 0; y < frame.strata.y; ++y)
        for (int x = 0; x < frame.strata.x; ++x) {
            const glm::uvec4 sample = frame.samples({x, y});
            if (sample.y == 0)
                continue;
            const int landing = int(sample.y) - 1;
            const glm::ivec2 p = 3 * glm::ivec2(x, y) + glm::ivec2(landing % 3, landing / 3);
            const glm::ivec2 source(int(sample.z & 0xffffu), int(sample.z >> 16));
            const bool isStill = frame.previousRaw(source).a == frame.raw(p).a;
            CHECK((gradient({x, y}).x == 0.0f) == isStill);
            ++(isStill ? still : changed);
        }
    CHECK(still > 20);
    CHECK(changed > 20);
}

TEST_CASE("a gradient a-trous iteration follows the paper, at every size, step and kernel") {
    double largest = 0.0;
    for (const glm::ivec2 size : kStageSizes)
        for (const std::uint32_t seed : {7u, 8u})
            for (const Kernel kernel : {Kernel::B3Spline5x5, Kernel::Box3x3})
                for (const int step : {1, 2, 3, 4, 5, 8, 16})
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
                        const auto filtered =
                            runGradientAtrous(testShaders(), frame, kernel, params);
                        const auto expected = reference::gradientAtrous(
                            frame.gradient, frame.strataGuides, frame.strataSlope, kernel, params);
                        CHECK_CLOSE(filtered, expected, kFilterTolerance);
                        largest = std::max(largest,
                                           compare(filtered, expected, kFilterTolerance).largest);
                    }
    MESSAGE("largest difference: ", largest);
}

TEST_CASE("lambda is the share that changed, 0 below the floor, or what it is forced to be") {
    double largest = 0.0;
    for (const glm::ivec2 size : kStageSizes)
        for (const std::uint32_t seed : {7u, 8u})
            for (const gpu::GradientParams& params :
                 {gpu::GradientParams{1e-4f, -1.0f, gpu::kGradientSigned, 0.0f},
                  gpu::GradientParams{0.8f, -1.0f, gpu::kGradientSigned, 0.0f},
                  gpu::GradientParams{0.0f, -1.0f, gpu::kGradientSigned, 0.0f},
                  gpu::GradientParams{1e-4f, 0.0f, gpu::kGradientSigned, 0.0f},
                  gpu::GradientParams{1e-4f, 0.3f, gpu::kGradientSigned, 0.0f},
                  gpu::GradientParams{1e-4f, 1.0f, gpu::kGradientSigned, 0.0f}}) {
                CAPTURE(size.x);
                CAPTURE(size.y);
                CAPTURE(seed);
                CAPTURE(params.deltaFloor);
                CAPTURE(params.forceLambda);
                RandomFrame frame(size, seed);
                frame.gradient({0, 0}) = glm::vec4(0.5f, 0.8f, 0.0f, 0.0f); // on one of the floors
                const auto lambda = runLambda(testShaders(), frame, params);
                const auto expected = reference::lambda(frame.gradient, params);
                CHECK_CLOSE(lambda, expected, kTolerance);
                largest = std::max(largest, compare(lambda, expected, kTolerance).largest);
            }
    MESSAGE("largest difference: ", largest);
}
