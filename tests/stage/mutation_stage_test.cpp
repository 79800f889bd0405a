// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <string>

#include "tests/reference/atrous.h"
#include "tests/reference/gradient.h"
#include "tests/reference/temporal.h"
#include "tests/reference/variance.h"
#include "tests/stage/mutants.h"
#include "tests/stage/stage_runner.h"

// Would the stage tests notice? Each case plants one error in the text of a shader, runs the real
// pass with it, and demands that the comparison with the reference fails by a clear margin.

using namespace afterglow;
using namespace afterglow::test;

namespace {

/// Usual ones, and some so wide that only the depth 0 of background keeps it out. One exponent of
/// the normals is no power of two.
const gpu::EdgeStopping kEdges[] = {
    {4.0f, 128.0f, 1.0f, 1}, {4.0f, 128.0f, 1.0f, 4}, {100.0f, 1.5f, 20.0f, 4}};

Verdict measureAtrousForm(ShaderLibrary& shaders) {
    Verdict verdict;
    const RandomFrame frame({61, 37}, 21);
    for (const Kernel kernel : {Kernel::B3Spline5x5, Kernel::Box3x3})
        for (const gpu::EdgeStopping& params : kEdges) {
            verdict.add(runAtrous(shaders, frame, kernel, params),
                        reference::atrous(frame.signal, frame.guides, frame.slope, kernel, params));
        }
    return verdict;
}

/// One pixel a thread.
Verdict measureAtrousBySampler(ShaderLibrary& shaders) {
    ShaderLibrary bySampler(shaders.source());
    return measureAtrousForm(bySampler);
}

/// Two pixels a thread.
Verdict measureAtrousByImage(ShaderLibrary& shaders) {
    ShaderLibrary byImage(shaders.source(), Defines{{"FETCH_BY_IMAGE", "1"}});
    return measureAtrousForm(byImage);
}

Verdict measureTemporal(ShaderLibrary& shaders) {
    Verdict verdict;
    for (const std::uint32_t seed : {21u, 22u, 23u})
        for (const int fetch : {gpu::kLambdaNearest, gpu::kLambdaBilinear, gpu::kLambdaMax})
            for (const int law :
                 {gpu::kHistoryEffective, gpu::kHistoryFrames, gpu::kHistoryPower}) {
                const RandomFrame frame({61, 37}, seed);
                const float maxHistory = law == gpu::kHistoryFrames ? 6.0f : 64.0f;
                const gpu::TemporalParams params{0.1f,
                                                 0.2f,
                                                 maxHistory,
                                                 1.0f,
                                                 0.9f,
                                                 fetch,
                                                 law,
                                                 gpu::kLambdaFromGradient,
                                                 gpu::kLambdaBlends,
                                                 1.0f,
                                                 1.0f,
                                                 -1,
                                                 20.0f,
                                                 8.0f,
                                                 16.0f,
                                                 0};
                const auto images = runTemporal(shaders, frame, true, params);
                const auto expected = reference::temporal(
                    {frame.raw, frame.visibility, frame.previousVisibility, frame.guides,
                     frame.previousGuides, frame.slope, frame.motion, frame.previousColor,
                     frame.previousMoments, frame.lambda, true},
                    params);
                verdict.add(images.accumulated, expected.accumulated);
                verdict.add(images.moments, expected.moments);
                verdict.add(images.control, expected.control);
            }
    return verdict;
}

Verdict measureVariance(ShaderLibrary& shaders) {
    Verdict verdict;
    const RandomFrame frame({61, 37}, 21);
    for (const gpu::VarianceParams& params :
         {gpu::VarianceParams{128.0f, 1.0f, 4.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f},
          gpu::VarianceParams{1.0f, 20.0f, 4.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f}})
        verdict.add(runVariance(shaders, frame, params),
                    reference::variance(
                        {frame.accumulated, frame.moments, frame.guides, frame.slope}, params));
    return verdict;
}

Verdict measureGradient(ShaderLibrary& shaders) {
    Verdict verdict;
    const RandomFrame frame({61, 37}, 21);
    const gpu::GradientParams params{1e-4f, -1.0f, gpu::kGradientSigned, 0.0f};
    verdict.add(
        runGradient(shaders, frame, params),
        reference::gradient({frame.raw, frame.previousRaw, frame.samples, frame.guides}, params));
    return verdict;
}

Verdict measureStrata(ShaderLibrary& shaders) {
    Verdict verdict;
    const RandomFrame frame({61, 37}, 21);
    const auto strata = runStrata(shaders, frame);
    const auto expected = reference::strataGuides(frame.guides, frame.slope);
    verdict.add(strata.guides, expected.guides);
    verdict.add(strata.slope, expected.slope);
    return verdict;
}

Verdict measureGradientAtrous(ShaderLibrary& shaders) {
    Verdict verdict;
    const RandomFrame frame({61, 37}, 21);
    for (const Kernel kernel : {Kernel::B3Spline5x5, Kernel::Box3x3}) {
        for (const gpu::EdgeStopping& params : kEdges)
            verdict.add(runGradientAtrous(shaders, frame, kernel, params),
                        reference::gradientAtrous(frame.gradient, frame.strataGuides,
                                                  frame.strataSlope, kernel, params));
    }
    return verdict;
}

Verdict measureLambda(ShaderLibrary& shaders) {
    Verdict verdict;
    RandomFrame frame({61, 37}, 21);
    frame.gradient({0, 0}) = glm::vec4(0.5f, 0.8f, 0.0f, 0.0f); // on the floor
    for (const float forced : {-1.0f, 0.0f, 0.3f}) {
        const gpu::GradientParams params{0.8f, forced, gpu::kGradientSigned, 0.0f};
        verdict.add(runLambda(shaders, frame, params), reference::lambda(frame.gradient, params));
    }
    return verdict;
}

} // namespace

TEST_CASE("errors planted in the a-trous iteration do not pass") {
    const std::string file = "denoise/atrous.comp", stops = "lib/edge_stopping.glsl";
    checkMutants(
        measureAtrousBySampler,
        {{"swizzle of the tap's luminance", file, "luminance(other.rgb)", "luminance(other.rbg)"},
         {"variance weight not squared", file, "w * w * other.a", "w * other.a"},
         {"variance normalized once", file,
          "pixel.varianceSum / (pixel.weightSum * pixel.weightSum)",
          "pixel.varianceSum / pixel.weightSum"},
         {"variance not smoothed", file, "fetch(signal, clamp(p + ivec2(x, y), ivec2(0), last)).a",
          "fetch(signal, p).a"},
         {"variance smoothed by another kernel", file, "1.0 / 2.0, 1.0 / 4.0",
          "1.0 / 3.0, 1.0 / 3.0"},
         {"standard deviation not rooted", stops, "sqrt(max(variance, 0.0))", "max(variance, 0.0)"},
         {"step forgotten in the depth weight", file, "float(params.step) * vec2(towards)",
          "vec2(towards)"},
         {"a tap and its mirror image", file, "? -k : k", "? ivec2(-k.x, k.y) : k"},
         {"background as a tap", stops, "otherGuide.w == 0.0 ? 0.0 : weight", "weight"},
         {"background blackened", file, "imageStore(filtered, p, fetch(signal, p))",
          "imageStore(filtered, p, vec4(0.0))"},
         {"a column too few", file, "x <= KERNEL_RADIUS", "x < KERNEL_RADIUS"},
         {"depth epsilon in meters", stops, "1e-3 * guide.w", "1e-3"},
         {"powers of 2 for powers of e", stops, "kLn2 = 0.69314718056", "kLn2 = 1.0"},
         {"slope taken by its length", stops, "abs(dot(stops.depthReach, offset))",
          "length(stops.depthReach) * length(offset)"},
         {"exponent of the normals forgotten", stops, "pow(cosine, sigma)", "cosine"},
         {"a squaring too few", stops, "int i = 0; i < NORMAL_SQUARINGS",
          "int i = 1; i < NORMAL_SQUARINGS"},
         {"spline with a heavy rim", "lib/kernel.glsl", "1.0 / 4.0, 1.0 / 16.0",
          "1.0 / 4.0, 1.0 / 8.0"},
         {"luminance of another color order", "lib/color.glsl", "0.2126, 0.7152, 0.0722",
          "0.0722, 0.7152, 0.2126"}});
}

TEST_CASE("errors planted in an a-trous iteration with two pixels a thread do not pass") {
    const std::string file = "denoise/atrous.comp";
    checkMutants(
        measureAtrousByImage,
        {{"the lower pixel takes the upper one's taps", file, "k - ivec2(0, 1), otherGuide",
          "k, otherGuide"},
         {"the upper pixel without its lowest taps", file, "if (k.y <= KERNEL_RADIUS)",
          "if (k.y < KERNEL_RADIUS)"},
         {"the lower pixel without its highest taps", file, "if (k.y > -KERNEL_RADIUS)",
          "if (k.y > 1 - KERNEL_RADIUS)"},
         {"5x5 without the last row", file, "ROW(2) ROW(3)", "ROW(2)"},
         {"5x5 without a tap of each row", file, "TAP(0, y) TAP(1, y) TAP(2, y)",
          "TAP(0, y) TAP(2, y)"},
         {"3x3 without the last row", file, "ROWS ROW(-1) ROW(0) ROW(1) ROW(2)",
          "ROWS ROW(-1) ROW(0) ROW(1)"},
         {"rows of the second half", file, "cell.y & -params.step", "cell.y & params.step"},
         {"pairs a row apart", file, "p + ivec2(0, params.step);", "p + ivec2(0, 1);"},
         {"a row too few at the bottom", file, "below.y <= last.y", "below.y < last.y"},
         {"background blackened", file, "pixel.stops.depth == 0.0 ? pixel.center",
          "pixel.stops.depth == 0.0 ? vec4(0.0)"},
         {"background as a tap", "lib/edge_stopping.glsl", "otherGuide.w == 0.0 ? 0.0 : weight",
          "weight"}});
}

TEST_CASE("errors planted in the temporal accumulation do not pass") {
    const std::string file = "denoise/temporal.comp";
    checkMutants(
        measureTemporal,
        {{"motion with the wrong sign", file, "vec2(p) + moved.xy", "vec2(p) - moved.xy"},
         {"motion with y upwards", file, "vec2(p) + moved.xy", "vec2(p) + moved.xy * vec2(1, -1)"},
         {"history fetched half a pixel off", file, "vec2(p) + moved.xy",
          "vec2(p) + 0.5 + moved.xy"},
         {"lambda forgotten for the moments", file,
          "(1.0 - l) * max(params.alphaMoments, leastWeight) + l",
          "max(params.alphaMoments, leastWeight)"},
         {"lambda added, not blended", file, "(1.0 - l) * max(params.alpha, leastWeight) + l",
          "min(1.0, max(params.alpha, leastWeight) + l)"},
         {"start of the average forgotten", file, "max(params.alpha, leastWeight)", "params.alpha"},
         {"color not normalized by the valid taps", file, "history.color /= weightSum;", ""},
         {"length not normalized by the valid taps", file, "history.samples /= weightSum;", ""},
         {"swizzle of the history", file, "fetch(previousColor, q).rgb",
          "fetch(previousColor, q).rbg"},
         {"depth tolerance in meters", file, "kDepthEpsilon * moved.z", "kDepthEpsilon"},
         {"depth against the current one", file, "instance, moved.z, tolerance",
          "instance, fetch(guides, p).w, tolerance"},
         {"instances not compared", file, "fetch(previousVisibility, q).x != instance",
          "fetch(previousVisibility, q).x < min(instance, 1u)"},
         {"normals not compared", file, ">= params.normalTolerance", ">= -2.0"},
         {"a trace of history accepted", file, "weightSum < kLeastWeight", "weightSum <= 0.0"},
         {"reason of the last of equals", file, "weight > largest", "weight >= largest"},
         {"points behind the camera accepted", file, "moved.w == 0.0", "false"},
         {"strata centered on their corner", file, "/ float(kStratumSize) - 0.5",
          "/ float(kStratumSize)"},
         {"largest lambda of the own stratum only", file, "lambdaOf(s + ivec2(x, y))",
          "lambdaOf(s)"},
         {"effective length with the weight not squared", file,
          "(1.0 - alpha) * (1.0 - alpha) / samples", "(1.0 - alpha) / samples"},
         {"a frame too many", file, "next = samples + 1.0", "next = samples + 2.0"},
         {"power of the third law", file, "pow(1.0 - l, 10.0)", "pow(1.0 - l, 8.0)"},
         {"no limit to the length", file, "min(next, params.maxHistory)", "next"},
         {"luminance of the raw signal for that of the history", file, "luminance(history.color)",
          "luminance(current.rgb)"},
         {"luminance of a history that nobody has", file,
          "hasHistory ? luminance(history.color) : 0.0", "luminance(history.color)"},
         {"background accumulated", file, "guide.w != 0.0", "true"},
         {"second moment of the mean", file, "current.a * current.a", "current.a"}});
}

TEST_CASE("errors planted in the variance stage do not pass") {
    const std::string file = "denoise/variance.comp";
    checkMutants(
        measureVariance,
        {{"factor 4/N dropped", file, "params.minHistory / samples", "1.0"},
         {"factor 4/N without a limit", file, "max(history, 1.0)", "(history + 1.0)"},
         {"5x5 for 7x7", file, "kRadius = 3", "kRadius = 2"},
         {"one frame too many in space", file, "history < params.minHistory",
          "history <= params.minHistory"},
         {"negative variance turned over", file, "max(0.0, mean.y - mean.x * mean.x)",
          "abs(mean.y - mean.x * mean.x)"},
         {"mean not squared", file, "mean.y - mean.x * mean.x", "mean.y - mean.x"},
         {"normals forgotten", file, "vec2(x, y), params.sigmaNormal)", "vec2(x, y), 0.0)"},
         {"background as a tap", "lib/edge_stopping.glsl", "otherGuide.w == 0.0 ? 0.0 : weight",
          "weight"},
         {"swizzle of the signal", file, "fetch(accumulated, p).rgb",
          "fetch(accumulated, p).rbg"}});
}

TEST_CASE("errors planted in the gradient samples do not pass") {
    const std::string file = "denoise/gradient.comp";
    checkMutants(
        measureGradient,
        {{"the smaller for the larger", file, "max(pair.now.a, pair.before.a)",
          "min(pair.now.a, pair.before.a)"},
         {"delta with the wrong sign", file, "pair.now.a - pair.before.a",
          "pair.before.a - pair.now.a"},
         {"delta without its sign", file, "pair.now.a - pair.before.a",
          "abs(pair.now.a - pair.before.a)"},
         {"magnitude exchanged", file, "== kGradientAbsolute", "!= kGradientAbsolute"},
         {"x and y of the place exchanged", file, "place % kStratumSize, place / kStratumSize",
          "place / kStratumSize, place % kStratumSize"},
         {"place off by one", file, "carried.y - 1u", "carried.y % 9u"},
         {"partial strata counted as whole", file, "(values[i] - mean) / float(count)",
          "(values[i] - mean) / 9.0"},
         {"variance of a sample", file, "(values[i] - mean) / float(count)",
          "(values[i] - mean) / max(1.0, float(count - 1))"},
         {"the old luminance where the sample landed", file, "unpackPixel(carried.z)",
          "s * 3 + ivec2((carried.y - 1u) % 3u, (carried.y - 1u) / 3u)"},
         {"the old luminance of this frame", file, "LightPair(fetch(previousRaw,",
          "LightPair(1e-30 * fetch(previousRaw, s) + fetch(raw,"}});
}

TEST_CASE("errors planted in the guides of strata do not pass") {
    const std::string file = "denoise/strata.comp";
    checkMutants(measureStrata,
                 {{"guides of the corner", file, "min(first + 1, last)", "min(first, last)"},
                  {"guides of the last pixel", file, "i < 9 && !found", "i < 9"},
                  {"guides of the second pixel", file, "i = 0; i < 9", "i = 1; i < 9"},
                  {"background has guides", file, "|| fetch(guides, p).w == 0.0", ""}});
}

TEST_CASE("errors planted in the gradient reconstruction do not pass") {
    const std::string file = "denoise/gradient_atrous.comp";
    checkMutants(
        measureGradientAtrous,
        {{"distance in strata", file, "vec2(offset) * float(kStratumSize)", "vec2(offset)"},
         {"edges of delta, not of luminance", file, "return c.change.z;", "return c.change.x;"},
         {"variance weight not squared", file, "c.change;\n    sum.variance += weight * weight",
          "c.change;\n    sum.variance += weight"},
         {"variance smoothed from another channel", file, "return fetch(gradient, s).w;",
          "return fetch(gradient, s).z;"},
         {"background as a tap", "lib/edge_stopping.glsl", "otherGuide.w == 0.0 ? 0.0 : weight",
          "weight"},
         {"background blackened", file, "store(s, center, 1.0)", "store(s, kNothing, 1.0)"},
         {"box with a light middle", "lib/kernel.glsl", "1.0 / 3.0, 1.0 / 3.0",
          "1.0 / 4.0, 3.0 / 8.0"}});
}

TEST_CASE("errors planted in lambda do not pass") {
    const std::string file = "denoise/lambda.comp";
    checkMutants(
        measureLambda,
        {{"lambda without its limit", file, "min(1.0, abs(change.x) / change.y)",
          "abs(change.x) / change.y"},
         {"darkening not seen", file, "abs(change.x)", "max(change.x, 0.0)"},
         {"numerator and denominator exchanged", file, "fetch(gradient, s).xy",
          "fetch(gradient, s).yx"},
         {"the floor itself counts", file, "change.y > params.deltaFloor",
          "change.y >= params.deltaFloor"},
         {"forcing 0 forgotten", file, "params.forceLambda >= 0.0", "params.forceLambda > 0.0"}});
}
