// SPDX-License-Identifier: MIT
// Would the tests of the competing filters notice? See mutation_stage_test.cpp.

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/reference/gradient.h"
#include "tests/reference/luminance_range.h"
#include "tests/stage/competitors.h"
#include "tests/stage/mutants.h"

using namespace afterglow;
using namespace afterglow::test;

namespace {

Verdict measureTemporal(ShaderLibrary& shaders, const std::vector<gpu::TemporalParams>& all) {
    Verdict verdict;
    for (const std::uint32_t seed : {21u, 22u}) {
        const RandomFrame frame({61, 37}, seed);
        for (const gpu::TemporalParams& params : all) {
            const auto images = runTemporal(shaders, frame, true, params);
            const auto expected = expect(frame, params);
            verdict.add(images.accumulated, expected.accumulated);
            verdict.add(images.moments, expected.moments);
            verdict.add(images.control, expected.control);
        }
    }
    return verdict;
}

} // namespace

TEST_CASE("errors planted in the luminance range do not pass") {
    const std::string file = "denoise/luminance_range.comp";
    checkMutants(
        [](ShaderLibrary& shaders) {
            Verdict verdict;
            for (const std::uint32_t seed : {21u, 22u}) {
                const RandomFrame frame({61, 37}, seed);
                for (const gpu::PercentileParams& params : kPercentiles)
                    verdict.add(runLuminanceRange(shaders, frame, params),
                                reference::luminanceRange(frame.raw, frame.guides, params));
            }
            return verdict;
        },
        {{"background counts", file, "fetch(guides, inside).w != 0.0",
          "fetch(guides, inside).w >= 0.0"},
         {"pixels beyond the edge count", file, "p == inside && ", ""},
         {"equal values in one place", file, "other == value && i < own", "false"},
         {"the nearest place instead of between two", file, "place - float(below));", "0.0);"},
         {"places of a whole tile", file, "float(count - 1);", "63.0;"},
         {"one place too far", file, "float(count - 1);", "float(count);"},
         {"low for high", file, "max(mean, percentile(params.highPercentile, count))",
          "max(mean, percentile(params.lowPercentile, count))"},
         {"mean of a whole tile", file, "sum / float(count)", "sum / 64.0"},
         {"mean forgotten below", file, "min(mean, percentile(params.lowPercentile, count))",
          "percentile(params.lowPercentile, count)"},
         {"mean forgotten above", file, "max(mean, percentile(params.highPercentile, count))",
          "percentile(params.highPercentile, count)"}});
}

TEST_CASE("errors planted in the clamp of the history do not pass") {
    const std::string file = "denoise/temporal.comp";
    checkMutants(
        [](ShaderLibrary& shaders) {
            return measureTemporal(shaders, {clamped(1, 0.5f), clamped(3, 1.0f)});
        },
        {{"background in the neighborhood", file, "if (fetch(guides, q).w == 0.0)", "if (false)"},
         {"half of the neighborhood", file, "x <= CLAMP_RADIUS", "x <= 0"},
         {"variance of a sample", file, "squares / max(count, 1.0)",
          "squares / max(count - 1.0, 1.0)"},
         {"deviation not rooted", file, "sqrt(squares / max(count, 1.0))",
          "(squares / max(count, 1.0))"},
         {"running variance around the old mean", file, "squares += off * (value - mean)",
          "squares += off * off"},
         {"clamped on one side", file, "clamp(color, mean - reach, mean + reach)",
          "min(color, mean + reach)"},
         {"sigmas forgotten", file, "params.clampSigmas * sqrt", "sqrt"},
         {"luminance of the clamped history", file, "hasHistory ? luminance(history.color) : 0.0",
          "hasHistory ? luminance(clampToNeighborhood(history.color, p)) : 0.0"},
         {"clamp forgotten", file, "history.color = clampToNeighborhood(history.color, p);", ""}});
}

TEST_CASE("errors planted in the distance from the range do not pass") {
    const std::string file = "denoise/temporal.comp";
    checkMutants(
        [](ShaderLibrary& shaders) {
            return measureTemporal(shaders, {adaptive(gpu::kLambdaFromRange, gpu::kLambdaBlends)});
        },
        {{"tiles centered on their corner", file, "/ float(kTileSize) - 0.5", "/ float(kTileSize)"},
         {"tiles that count alike", file, "(place.y == 1 ? f.y : 1.0 - f.y) * tile.z",
          "(place.y == 1 ? f.y : 1.0 - f.y)"},
         {"only the dark end", file, "max(range.x - historyLuminance, historyLuminance - range.y)",
          "range.x - historyLuminance"},
         {"only the bright end", file,
          "max(range.x - historyLuminance, historyLuminance - range.y)",
          "historyLuminance - range.y"},
         {"distance in radiance", file, "outside / (range.y - range.x + 1e-4)", "outside"},
         {"no limit", file, "min(1.0, params.percentileSlope * outside",
          "(params.percentileSlope * outside"},
         {"lambda without a history", file, "kLambdaFromRange && hasHistory", "kLambdaFromRange"}});
}

TEST_CASE("errors planted in the confidence do not pass") {
    const std::string file = "denoise/temporal.comp";
    checkMutants(
        [](ShaderLibrary& shaders) {
            std::vector<gpu::TemporalParams> all;
            for (const int law : {gpu::kHistoryEffective, gpu::kHistoryPower})
                all.push_back(adaptive(gpu::kLambdaFromGradient, gpu::kLambdaCuts, law));
            return measureTemporal(shaders, all);
        },
        {{"confidence not squared", file, "(1.0 - l) * (1.0 - l)", "(1.0 - l)"},
         {"a frame kept whatever happened", file, "(1.0 - confidence) / (history.samples + 1.0)",
          "(1.0 - confidence) / max(history.samples, 1.0)"},
         {"cut to nothing", file, "confidence + (1.0 - confidence) / (history.samples + 1.0)",
          "confidence"},
         {"cut and blended", file, "(history.samples + 1.0);\n        l = 0.0;\n",
          "(history.samples + 1.0);\n"},
         {"lambda not told", file, "vec4(fetchedLambda, alpha", "vec4(l, alpha"}});
}

TEST_CASE("errors planted in what NRD does with the gradient do not pass") {
    const auto measure = [](ShaderLibrary& shaders) {
        Verdict verdict;
        const RandomFrame frame({61, 37}, 21);
        const gpu::GradientParams gradient{1e-4f, -1.0f, gpu::kGradientAbsolute, 0.0f};
        verdict.add(runGradient(shaders, frame, gradient),
                    reference::gradient({frame.raw, frame.previousRaw, frame.samples, frame.guides},
                                        gradient));
        const gpu::EdgeStopping edges{0.0f, 128.0f, 1.0f, 3};
        verdict.add(runGradientAtrous(shaders, frame, Kernel::B3Spline5x5, edges),
                    reference::gradientAtrous(frame.gradient, frame.strataGuides, frame.strataSlope,
                                              Kernel::B3Spline5x5, edges));
        return verdict;
    };
    checkMutants(measure, {{"signs kept", "denoise/gradient.comp", "abs(difference)", "difference"},
                           {"no stop for a steep one", "denoise/gradient_atrous.comp",
                            "params.sigmaLuminance == 0.0", "params.sigmaLuminance < 0.0"}});
}
