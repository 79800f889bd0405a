// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "tests/reference/variance.h"
#include "tests/stage/stage_runner.h"
#include "tests/support/compare.h"
#include "tests/support/gl_fixture.h"

using namespace afterglow;
using namespace afterglow::test;

namespace {

// llvmpipe: 2.5e-6; the rest is for pow() and exp() on GPUs.
constexpr Tolerance kTolerance{.max = 3e-5, .relative = 3e-5};

} // namespace

TEST_CASE("variance follows the paper, at every size, with short and long histories") {
    double largest = 0.0;
    for (const glm::ivec2 size : kStageSizes)
        for (const std::uint32_t seed : {7u, 8u, 9u})
            for (const gpu::VarianceParams& params :
                 {gpu::VarianceParams{128.0f, 1.0f, 4.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f},
                  gpu::VarianceParams{8.0f, 0.25f, 4.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f},
                  gpu::VarianceParams{32.0f, 10.0f, 11.0f, 0.0f, 0.0f, 0.0f, 0.0f,
                                      0.0f}, // all of them short
                  gpu::VarianceParams{32.0f, 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f,
                                      0.0f}}) { // all of them long
                CAPTURE(size.x);
                CAPTURE(size.y);
                CAPTURE(seed);
                CAPTURE(params.minHistory);
                const RandomFrame frame(size, seed);
                const auto filtered = runVariance(testShaders(), frame, params);
                const auto expected = reference::variance(
                    {frame.accumulated, frame.moments, frame.guides, frame.slope}, params);
                CHECK_CLOSE(filtered, expected, kTolerance);
                largest = std::max(largest, compare(filtered, expected, kTolerance).largest);
                for (const glm::vec4& pixel : filtered.pixels())
                    CHECK(pixel.a >= 0.0f);
            }
    MESSAGE("largest difference: ", largest);
}

TEST_CASE("the variance stage does not touch the signal") {
    const RandomFrame frame({61, 37}, 7);
    const auto filtered =
        runVariance(testShaders(), frame, {128.0f, 1.0f, 4.0f, 1.25f, 2.0f, 0.0f, 0.0f, 0.0f});
    int compared = 0;
    for (std::size_t i = 0; i < filtered.pixels().size(); ++i)
        if (frame.guides.pixels()[i].w != 0.0f) {
            CHECK(glm::vec3(filtered.pixels()[i]) == glm::vec3(frame.accumulated.pixels()[i]));
            ++compared;
        }
    CHECK(compared > 500);
}
