// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "tests/reference/atrous.h"
#include "tests/stage/stage_runner.h"
#include "tests/support/compare.h"
#include "tests/support/gl_fixture.h"

using namespace afterglow;
using namespace afterglow::test;

namespace {

// llvmpipe: 4e-6, where little variance makes the luminance weight steep; the rest is for pow() and
// exp() on GPUs.
constexpr Tolerance kTolerance{.max = 3e-5, .relative = 3e-5};

double checkAtrous(const RandomFrame& frame, Kernel kernel, const gpu::EdgeStopping& params) {
    const auto filtered = runAtrous(testShaders(), frame, kernel, params);
    const auto expected =
        reference::atrous(frame.signal, frame.guides, frame.slope, kernel, params);
    CHECK_CLOSE(filtered, expected, kTolerance);
    return compare(filtered, expected, kTolerance).largest;
}

} // namespace

TEST_CASE("an a-trous iteration follows the paper, at every size, step and kernel") {
    double largest = 0.0;
    for (const glm::ivec2 size : kStageSizes)
        for (const std::uint32_t seed : {7u, 8u})
            for (const Kernel kernel : {Kernel::B3Spline5x5, Kernel::Box3x3})
                for (const int step : {1, 2, 4, 8, 16}) {
                    CAPTURE(size.x);
                    CAPTURE(size.y);
                    CAPTURE(seed);
                    CAPTURE(int(kernel));
                    CAPTURE(step);
                    largest = std::max(largest, checkAtrous(RandomFrame(size, seed), kernel,
                                                            {4.0f, 128.0f, 1.0f, step}));
                }
    MESSAGE("largest difference: ", largest);
}

TEST_CASE("an a-trous iteration follows the paper, at narrow and wide edge stops") {
    double largest = 0.0;
    const RandomFrame frame({61, 37}, 9);
    for (const Kernel kernel : {Kernel::B3Spline5x5, Kernel::Box3x3})
        for (const float sigmaLuminance : {0.5f, 100.0f})
            for (const float sigmaNormal : {1.0f, 32.0f})
                for (const float sigmaDepth : {0.25f, 20.0f}) {
                    CAPTURE(int(kernel));
                    CAPTURE(sigmaLuminance);
                    CAPTURE(sigmaNormal);
                    CAPTURE(sigmaDepth);
                    largest = std::max(
                        largest,
                        checkAtrous(frame, kernel, {sigmaLuminance, sigmaNormal, sigmaDepth, 2}));
                }
    MESSAGE("largest difference: ", largest);
}
