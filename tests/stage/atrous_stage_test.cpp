// SPDX-License-Identifier: MIT
// One iteration of the a-trous filter, in both of its forms: one pixel a thread, as on a GPU, and
// two, as on a software rasterizer.
#include <doctest/doctest.h>

#include <algorithm>
#include <stdexcept>

#include "tests/reference/atrous.h"
#include "tests/stage/stage_runner.h"
#include "tests/support/compare.h"
#include "tests/support/gl_fixture.h"

using namespace afterglow;
using namespace afterglow::test;

namespace {

// llvmpipe: 5e-6, where little variance makes the luminance weight steep; the rest is for pow() and
// exp2() on GPUs.
constexpr Tolerance kTolerance{.max = 3e-5, .relative = 3e-5};

// Between the two forms: they sum the same weights in another order. llvmpipe: 1e-6.
constexpr Tolerance kBetweenForms{.max = 1e-5, .relative = 1e-5};

constexpr Kernel kKernels[] = {Kernel::B3Spline5x5, Kernel::Box3x3};

/// Sizes of which no height but one is a multiple of two steps.
constexpr glm::ivec2 kSizes[] = {{61, 37}, {1, 1},   {2, 5},  {8, 8},
                                 {16, 9},  {130, 3}, {9, 33}, {7, 64}};

double checkAtrous(ShaderLibrary& shaders, const RandomFrame& frame, Kernel kernel,
                   const gpu::EdgeStopping& params, const Tolerance& tolerance = kTolerance) {
    const auto filtered = runAtrous(shaders, frame, kernel, params);
    const auto expected =
        reference::atrous(frame.signal, frame.guides, frame.slope, kernel, params);
    CHECK_CLOSE(filtered, expected, tolerance);
    return compare(filtered, expected, tolerance).largest;
}

/// The two forms. Where testShaders() fetches by sampler they are the same.
struct Forms {
    ShaderLibrary onePixel{testShaders().source()};
    ShaderLibrary twoPixels{testShaders().source(), {{"FETCH_BY_IMAGE", "1"}}};
};

/// Calls check(shaders) with each.
void eachForm(auto check) {
    Forms forms;
    for (ShaderLibrary* shaders : {&forms.onePixel, &forms.twoPixels}) {
        CAPTURE(shaders->fetchesByImage());
        check(*shaders);
    }
}

} // namespace

TEST_CASE("an a-trous iteration follows the paper, at every size, step and kernel") {
    eachForm([](ShaderLibrary& shaders) {
        double largest = 0.0;
        for (const glm::ivec2 size : kStageSizes)
            for (const std::uint32_t seed : {7u, 8u})
                for (const Kernel kernel : kKernels)
                    for (const int step : {1, 2, 4, 8, 16}) {
                        CAPTURE(size.x);
                        CAPTURE(size.y);
                        CAPTURE(seed);
                        CAPTURE(int(kernel));
                        CAPTURE(step);
                        largest =
                            std::max(largest, checkAtrous(shaders, RandomFrame(size, seed), kernel,
                                                          {4.0f, 128.0f, 1.0f, step}));
                    }
        MESSAGE("largest difference: ", largest);
    });
}

TEST_CASE("an a-trous iteration follows the paper, at narrow and wide edge stops") {
    const RandomFrame frame({61, 37}, 9);
    eachForm([&](ShaderLibrary& shaders) {
        double largest = 0.0;
        for (const Kernel kernel : kKernels)
            for (const float sigmaLuminance : {0.5f, 100.0f})
                for (const float sigmaNormal : {1.0f, 32.0f})
                    for (const float sigmaDepth : {0.25f, 20.0f}) {
                        CAPTURE(int(kernel));
                        CAPTURE(sigmaLuminance);
                        CAPTURE(sigmaNormal);
                        CAPTURE(sigmaDepth);
                        largest = std::max(
                            largest, checkAtrous(shaders, frame, kernel,
                                                 {sigmaLuminance, sigmaNormal, sigmaDepth, 2}));
                    }
        MESSAGE("largest difference: ", largest);
    });
}

TEST_CASE("any exponent of the normals is taken, squared where it is a power of two") {
    const RandomFrame frame({61, 37}, 10);
    eachForm([&](ShaderLibrary& shaders) {
        for (const float sigmaNormal : {0.0f, 0.5f, 1.0f, 2.0f, 3.0f, 100.0f, 128.0f, 1024.0f}) {
            CAPTURE(sigmaNormal);
            // A cosine is rounded by 6e-8, and its power by that times the exponent.
            const double rounding = std::max(3e-5, 3e-7 * double(sigmaNormal));
            checkAtrous(shaders, frame, Kernel::Box3x3, {100.0f, sigmaNormal, 1.0f, 4},
                        {.max = rounding, .relative = rounding});
        }
    });
    for (const float sigmaNormal : {0.0f, 0.5f, 3.0f, 127.9f, 2048.0f})
        CHECK(definesOf(Kernel::Box3x3, sigmaNormal).size() == 1);
    for (int n = 0; n <= 10; ++n)
        CHECK(definesOf(Kernel::Box3x3, float(1 << n)).at(1).second == std::to_string(n));
}

TEST_CASE("with two pixels a thread the sums are those of one a thread, but for their rounding") {
    Forms forms;
    double largest = 0.0;
    for (const glm::ivec2 size : kSizes)
        for (const Kernel kernel : kKernels)
            for (const float sigmaNormal : {128.0f, 100.0f})
                for (const int step : {1, 2, 4, 8, 16, 32}) {
                    CAPTURE(size.x);
                    CAPTURE(size.y);
                    CAPTURE(int(kernel));
                    CAPTURE(sigmaNormal);
                    CAPTURE(step);
                    const RandomFrame frame(size, 12);
                    const gpu::EdgeStopping params{4.0f, sigmaNormal, 1.0f, step};
                    const auto one = runAtrous(forms.onePixel, frame, kernel, params);
                    const auto two = runAtrous(forms.twoPixels, frame, kernel, params);
                    CHECK_CLOSE(two, one, kBetweenForms);
                    largest = std::max(largest, compare(two, one, kBetweenForms).largest);
                }
    MESSAGE("largest difference: ", largest);
}

TEST_CASE("background passes an a-trous iteration with all its bits") {
    RandomFrame frame({61, 37}, 13);
    eachForm([&](ShaderLibrary& shaders) {
        const auto filtered =
            runAtrous(shaders, frame, Kernel::B3Spline5x5, {4.0f, 128.0f, 1.0f, 4});
        int background = 0;
        for (std::size_t i = 0; i < filtered.pixels().size(); ++i)
            if (frame.guides.pixels()[i].w == 0.0f) {
                ++background;
                CHECK(filtered.pixels()[i] == frame.signal.pixels()[i]);
            }
        CHECK(background > 50);
    });
}

TEST_CASE("a step of an a-trous iteration that is no power of two is refused") {
    const RandomFrame frame({8, 8}, 14);
    for (const int step : {0, -1, 3, 12})
        CHECK_THROWS_AS(runAtrous(testShaders(), frame, Kernel::Box3x3, {4.0f, 128.0f, 1.0f, step}),
                        std::logic_error);
}
