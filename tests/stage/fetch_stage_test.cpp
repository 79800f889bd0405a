// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "tests/stage/counted.h"
#include "tests/support/compare.h"
#include "tests/support/gl_fixture.h"

using namespace afterglow;
using namespace afterglow::test;

// All stages but the a-trous iteration, whose two forms are compared in atrous_stage_test.cpp.
TEST_CASE("fetching by sampler and by image gives the same bits in every stage") {
    // As on a GPU: without FETCH_BY_IMAGE. Where testShaders() is that already, this is trivial.
    ShaderLibrary bySampler(testShaders().source());
    const auto each = [&](auto run) {
        const auto a = run(testShaders());
        const auto b = run(bySampler);
        CHECK_CLOSE(a, b, Tolerance{});
    };
    const gpu::EdgeStopping edges{4.0f, 128.0f, 1.0f, 2};
    for (const glm::ivec2 size : kStageSizes) {
        CAPTURE(size.x);
        CAPTURE(size.y);
        const RandomFrame frame(size, 31);
        for (const Kernel kernel : {Kernel::B3Spline5x5, Kernel::Box3x3}) {
            each([&](ShaderLibrary& s) { return runGradientAtrous(s, frame, kernel, edges); });
            each([&](ShaderLibrary& s) {
                return runLightPairsAtrous(s, frame, kernel, edges).before;
            });
            each(
                [&](ShaderLibrary& s) { return runLightPairsAtrous(s, frame, kernel, edges).now; });
            each([&](ShaderLibrary& s) {
                return runLightPairsAtrous(s, frame, kernel, edges).products;
            });
        }
        const gpu::GradientParams gradient{1e-4f, -1.0f, gpu::kGradientAbsolute, 0.0f};
        each([&](ShaderLibrary& s) { return runGradient(s, frame, gradient); });
        each([&](ShaderLibrary& s) { return runLightPairs(s, frame).products; });
        each([&](ShaderLibrary& s) { return runChange(s, frame, kChanges[0]).change; });
        each([&](ShaderLibrary& s) { return runTemporal(s, frame, true, kCounts).accumulated; });
        each([&](ShaderLibrary& s) { return runTemporal(s, frame, true, kCounts).control; });
        each([&](ShaderLibrary& s) { return runStrata(s, frame).guides; });
        each([&](ShaderLibrary& s) {
            return runVariance(s, frame, {128.0f, 1.0f, 4.0f, 1.25f, 2.0f, 0.0f, 0.0f, 0.0f});
        });
        each([&](ShaderLibrary& s) { return runLambda(s, frame, gradient); });
        each([&](ShaderLibrary& s) {
            return runLuminanceRange(s, frame, {0.1f, 0.9f, 0.0f, 0.0f});
        });
        for (const int source : {gpu::kLambdaFromGradient, gpu::kLambdaFromRange}) {
            const gpu::TemporalParams temporal{0.1f,
                                               0.2f,
                                               64.0f,
                                               2.0f,
                                               0.9f,
                                               gpu::kLambdaBilinear,
                                               gpu::kHistoryEffective,
                                               source,
                                               gpu::kLambdaCuts,
                                               1.0f,
                                               0.5f,
                                               2,
                                               20.0f,
                                               3.0f,
                                               2.0f,
                                               1};
            each([&](ShaderLibrary& s) {
                return runTemporal(s, frame, true, temporal).accumulated;
            });
            each([&](ShaderLibrary& s) { return runTemporal(s, frame, true, temporal).moments; });
            each([&](ShaderLibrary& s) { return runTemporal(s, frame, true, temporal).control; });
        }
    }
}
