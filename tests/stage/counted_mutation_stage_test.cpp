// SPDX-License-Identifier: MIT
// Would the tests of the change of light and of the counted history notice? See
// mutation_stage_test.cpp.

#include <doctest/doctest.h>

#include <string>

#include "tests/reference/variance.h"
#include "tests/stage/counted.h"
#include "tests/stage/mutants.h"

using namespace afterglow;
using namespace afterglow::test;

namespace {

void addPairs(Verdict& verdict, const LightPairImages& actual,
              const reference::LightPairs& expected) {
    verdict.add(actual.before, expected.before);
    verdict.add(actual.now, expected.now);
    verdict.add(actual.products, expected.products);
}

Verdict measurePairs(ShaderLibrary& shaders) {
    Verdict verdict;
    for (const std::uint32_t seed : {21u, 22u}) {
        const RandomFrame frame({61, 37}, seed);
        const LightPairImages pairs = runLightPairs(shaders, frame);
        const auto expected =
            reference::lightPairs({frame.raw, frame.previousRaw, frame.samples, frame.guides});
        addPairs(verdict, pairs, expected);
        verdict.add(double(pairs.changed), double(expected.changed));
    }
    return verdict;
}

Verdict measurePairsAtrous(ShaderLibrary& shaders) {
    Verdict verdict;
    const RandomFrame frame({61, 37}, 21);
    for (const float sigmaLuminance : {4.0f, 0.0f}) {
        const gpu::EdgeStopping params{sigmaLuminance, 128.0f, 20.0f, 2};
        addPairs(verdict, runLightPairsAtrous(shaders, frame, Kernel::Box3x3, params),
                 reference::lightPairsAtrous({frame.before, frame.now, frame.products},
                                             frame.strataGuides, frame.strataSlope, Kernel::Box3x3,
                                             params));
    }
    return verdict;
}

Verdict measureChange(ShaderLibrary& shaders) {
    Verdict verdict;
    for (const std::uint32_t seed : {21u, 22u})
        for (const gpu::ChangeParams& params : kChanges) {
            const RandomFrame frame({61, 37}, seed);
            const ChangeOfLight found = runChange(shaders, frame, params);
            const auto expected =
                reference::change({frame.before, frame.now, frame.products}, params);
            verdict.add(found.lambda, expected.lambda);
            verdict.add(found.change, expected.change);
        }
    return verdict;
}

void addTemporal(Verdict& verdict, ShaderLibrary& shaders, const RandomFrame& frame,
                 const gpu::TemporalParams& params) {
    const TemporalImages images = runTemporal(shaders, frame, true, params);
    const auto expected = expectCounted(frame, params);
    verdict.add(images.accumulated, expected.accumulated);
    verdict.add(images.moments, expected.moments);
    verdict.add(images.control, expected.control);
}

/// By one fetch, so by one program.
Measure measureCounted(int fetch) {
    return [fetch](ShaderLibrary& shaders) {
        Verdict verdict;
        for (const std::uint32_t seed : {24u, 25u})
            for (const std::uint32_t changed : {0u, 1u, 2u})
                for (const int once : {0, 1}) {
                    gpu::TemporalParams params = kCounts;
                    params.lambdaFetch = fetch;
                    params.countReusedOnce = once;
                    params.maxHistory = 8.0f;
                    addTemporal(verdict, shaders, countedFrame({61, 37}, seed, changed), params);
                }
        return verdict;
    };
}

Verdict measureVariance(ShaderLibrary& shaders) {
    Verdict verdict;
    const RandomFrame frame({61, 37}, 21);
    for (const float exponent : {0.0f, 1.25f}) {
        const gpu::VarianceParams params{1.0f, 20.0f, 4.0f, exponent, 3.0f, 0.0f, 0.0f, 0.0f};
        verdict.add(runVariance(shaders, frame, params),
                    reference::variance(
                        {frame.accumulated, frame.moments, frame.guides, frame.slope}, params));
    }
    return verdict;
}

} // namespace

TEST_CASE("errors planted in light pairs do not pass") {
    const std::string file = "denoise/gradient.comp", atrous = "denoise/gradient_atrous.comp";
    checkMutants(
        measurePairs,
        {{"a change is ten times as large", file, "kLeastChange = 1e-3", "kLeastChange = 1e-2"},
         {"a change is half as large", file, "kLeastChange = 1e-3", "kLeastChange = 4e-4"},
         {"next to black everything changes", file, "(larger + 1e-3)", "larger"},
         {"all channels must change", file, "any(greaterThan(abs(pair", "all(greaterThan(abs(pair"},
         {"only brightening counts", file, "abs(pair.now.rgb - pair.before.rgb)",
          "(pair.now.rgb - pair.before.rgb)"},
         {"the frames of the product exchanged", file, "vec4(dot(pair.before.rgb, pair.before.rgb)",
          "vec4(dot(pair.now.rgb, pair.now.rgb)"},
         {"a sample is there everywhere", file, "float(pair.isThere)", "1.0"}});
    checkMutants(
        measurePairsAtrous,
        {{"edges of the share of samples", atrous, "return c.now.a;", "return c.before.a;"},
         {"variance of another channel", atrous, "fetch(products, s).w;", "fetch(products, s).z;"},
         {"products by squared weights", atrous, "sum.products += weight *",
          "sum.products += weight * weight *"},
         {"variance normalized once", atrous,
          "vec4(sum.products / weight, sum.variance / (weight * weight))",
          "vec4(sum.products / weight, sum.variance / weight)"},
         {"a luminance stop that nobody asked for", atrous, "if (params.sigmaLuminance == 0.0)",
          "if (params.sigmaLuminance < 0.0)"}});
}

TEST_CASE("errors planted in the change of light do not pass") {
    const std::string file = "denoise/change.comp";
    checkMutants(
        measureChange,
        {{"the floor of another sum", file, "light <= params.deltaFloor",
          "luminance(a) <= params.deltaFloor"},
         {"change of the mean channel", file, "largestOf(abs(b - a) / (max(a, b) + 0.02 * light))",
          "sumOf(abs(b - a) / (max(a, b) + 0.02 * light)) / 3.0"},
         {"a part of the dark light forgotten", file, "0.02 * light", "0.01 * light"},
         {"darkening not seen", file, "abs(luminance(b) - luminance(a))",
          "max(0.0, luminance(b) - luminance(a))"},
         {"squared sums for sums of squares", file, "p.x * n - dot(a, a), p.z * n",
          "p.x - dot(a, a), p.z"},
         {"variance of this frame alone", file, "max(p.x * n - dot(a, a), p.z * n - dot(b, b))",
          "p.z * n - dot(b, b)"},
         {"variance relative to this frame alone", file, "max(dot(a, a), dot(b, b)) + kTiny",
          "dot(b, b) + kTiny"},
         {"factor of the other direction", file, "? sumB / sumA : 1.0", "? sumA / sumB : 1.0"},
         {"mixed product once", file, "2.0 * factor * p.y", "factor * p.y"},
         {"samples forgotten in what is unexplained", file, "unexplained / (n * (",
          "unexplained / (("},
         {"doubt not asked for", file, "params.scaleDoubt * rho", "rho"},
         {"belief of the root", file, "float belief = l * l / (l * l + ",
          "float belief = l / (l + "},
         {"scaled though not asked for", file, "params.scaleHistory == 0 || isForced", "isForced"},
         {"scaled though forced", file, "params.scaleHistory == 0 || isForced",
          "params.scaleHistory == 0"},
         {"no limit to the factor", file, "clamp(ratio, 0.0, kLargestScale)", "ratio"},
         {"limit of the factor", file, "kLargestScale = 8.0", "kLargestScale = 4.0"},
         {"factor believed as a whole", file, "1.0 + belief * (", "1.0 + ("},
         {"little light left out of the factor", file, "(sumA + 1e-3 * light + 1e-6)",
          "(sumA + 1e-6)", 5e-3},
         {"strata without samples vote", file, "first.a > 0.0 ? light : 0.0", "light"},
         {"weight of this frame's light", file, "first.a > 0.0 ? light : 0.0",
          "first.a > 0.0 ? luminance(b) : 0.0"},
         {"weight while forced", file, "isForced ? 1.0 : weight", "weight"},
         {"lambda for what is left of its square", file, "vec4(l * l * (1.0 - belief)",
          "vec4(l * (1.0 - belief)"}});
}

TEST_CASE("errors planted in the counted history do not pass") {
    const std::string file = "lib/counted_history.glsl", main = "denoise/temporal.comp";
    checkMutants(
        measureCounted(gpu::kLambdaLight),
        {{"corners as near as edges", file, "float[](2.0, 1.0)", "float[](1.0, 1.0)"},
         {"strata that have no light vote", file, "kNear[abs(y)] * c.w", "kNear[abs(y)]"},
         {"moments scaled alike", file, "vec2(c.scale, c.scale * c.scale)", "vec2(c.scale)"},
         {"a change of the picture at a hundredth", file, "kMostStillStrata = 0.005",
          "kMostStillStrata = 0.01"},
         {"variance without its least value", file, "clamp(variance, 0.05, 4.0)",
          "clamp(variance, 0.01, 4.0)"},
         {"weights of the factor forgotten", file, "scale += weight * c.w * c.z",
          "scale += weight * c.z"},
         {"no lambda in what is left", file, "(1.0001 - c.lambda)", "1.0"},
         {"a stratum's samples in columns", file,
          "uint(inStratum.x) + kStratumSize * uint(inStratum.y)",
          "uint(inStratum.y) + kStratumSize * uint(inStratum.x)"},
         {"a reused sample counts by what is left", file, "1.0 - after / before", "after / before"},
         {"whole pixels are between", main, "0.5 - kBetweenPixels", "0.5"},
         {"between in both directions only", main, "any(lessThan(abs(f - 0.5)",
          "all(lessThan(abs(f - 0.5)"},
         {"no limit to the count", main, "min(history.samples + newest, params.maxHistory)",
          "history.samples + newest"}});
    checkMutants(measureCounted(gpu::kLambdaNearest),
                 {{"scaled where nothing changed", file, "c.lambda > 0.0", "c.lambda >= 0.0"}});
    checkMutants(measureCounted(gpu::kLambdaMax),
                 {{"the largest of the own row", file, "changeOf(s + ivec2(x, y)).x",
                   "changeOf(s + ivec2(x, 0)).x"}});
    checkMutants(measureCounted(gpu::kLambdaBilinear),
                 {{"E of the own stratum", file, "vec2(lambdaOf(corner + place), c.x)",
                   "vec2(lambdaOf(corner + place), changeOf(s).x)"}});
}

TEST_CASE("errors planted in the variance of a mean do not pass") {
    const std::string file = "denoise/variance.comp";
    checkMutants(
        measureVariance,
        {{"variance of one sample", file, "pow(samples, -params.varianceExponent)", "1.0"},
         {"raised by N, not by its square", file, "params.shortHistoryBoost / (samples * samples)",
          "params.shortHistoryBoost / samples"},
         {"raised by 4/N as well", file, "else if (radius >= 0)", "if (radius >= 0)"}});
}
