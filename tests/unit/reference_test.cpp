// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "tests/reference/atrous.h"
#include "tests/reference/gradient.h"
#include "tests/reference/temporal.h"
#include "tests/reference/variance.h"
#include "tests/support/random_frame.h"

using namespace afterglow;

namespace {

const gpu::EdgeStopping kSvgf{
    .sigmaLuminance = 4.0f, .sigmaNormal = 128.0f, .sigmaDepth = 1.0f, .step = 1};
const gpu::TemporalParams kTemporal{.alpha = 0.1f,
                                    .alphaMoments = 0.2f,
                                    .maxHistory = 1000.0f,
                                    .depthTolerance = 2.0f,
                                    .normalTolerance = 0.9f,
                                    .lambdaFetch = gpu::kLambdaNearest,
                                    .historyLaw = gpu::kHistoryEffective,
                                    .lambdaSource = gpu::kLambdaFromGradient,
                                    .lambdaUse = gpu::kLambdaBlends,
                                    .percentileSlope = 1.0f,
                                    .clampSigmas = 1.0f,
                                    .clampRadius = -1,
                                    .reactivity = 20.0f,
                                    .historyDuringChange = 8.0f,
                                    .historyBetweenPixels = 16.0f,
                                    .countReusedOnce = 1};

const gpu::VarianceParams kVariance{.sigmaNormal = 128.0f,
                                    .sigmaDepth = 1.0f,
                                    .minHistory = 4.0f,
                                    .varianceExponent = 0.0f,
                                    .shortHistoryBoost = 0.0f,
                                    .unused0 = 0.0f,
                                    .unused1 = 0.0f,
                                    .unused2 = 0.0f};

gpu::GradientParams gradientParams(float deltaFloor, float forceLambda) {
    return {deltaFloor, forceLambda, gpu::kGradientSigned, 0.0f};
}

constexpr Kernel kKernels[] = {Kernel::B3Spline5x5, Kernel::Box3x3};

/// A wall that faces the viewer and fills the picture, two meters away, in front of a camera at
/// rest: every pixel keeps its history.
struct Wall {
    explicit Wall(glm::ivec2 size)
        : visibility(size, glm::uvec4(1, 0, 0, 0)), guides(size, glm::vec4(0, 0, 1, 2)),
          slope(size, glm::vec2(0)), motion(size, glm::vec4(0, 0, 2, 1)), raw(size), color(size),
          moments(size), lambda(reference::strataOf(size)) {}

    reference::TemporalResult temporal(const gpu::TemporalParams& params) const {
        return reference::temporal({raw, visibility, visibility, guides, guides, slope, motion,
                                    color, moments, lambda, true},
                                   params);
    }

    Image<glm::uvec4> visibility;
    Image<glm::vec4> guides;
    Image<glm::vec2> slope;
    Image<glm::vec4> motion, raw, color, moments;
    Image<float> lambda;
};

template <class Pixel>
void fill(Image<Pixel>& image, Pixel value) {
    for (Pixel& pixel : image.pixels())
        pixel = value;
}

Image<glm::vec4> toFloat(const Image<glm::dvec4>& image) {
    Image<glm::vec4> result(image.size());
    for (std::size_t i = 0; i < image.pixels().size(); ++i)
        result.pixels()[i] = glm::vec4(image.pixels()[i]);
    return result;
}

} // namespace

TEST_CASE("the shares of each kernel sum to one") {
    for (const Kernel kernel : kKernels) {
        double sum = 0.0;
        const int r = reference::radius(kernel);
        for (int y = -r; y <= r; ++y)
            for (int x = -r; x <= r; ++x)
                sum += reference::share(kernel, {x, y});
        CHECK(sum == doctest::Approx(1.0).epsilon(1e-14));
    }
}

TEST_CASE("five iterations reach 125 pixels with the spline and 63 with the box") {
    for (const Kernel kernel : kKernels) {
        // One lit pixel in a row of a wall. Its surroundings are noisy, so luminance stops nothing.
        const glm::ivec2 size{141, 1};
        const Wall wall(size);
        Image<glm::vec4> image(size, glm::vec4(0, 0, 0, 1e12f));
        image({70, 0}) = glm::vec4(1e6f, 1e6f, 1e6f, 1e12f);
        for (const int step : {1, 2, 4, 8, 16}) {
            gpu::EdgeStopping params = kSvgf;
            params.step = step;
            params.sigmaLuminance = 1e6f;
            image = toFloat(reference::atrous(image, wall.guides, wall.slope, kernel, params));
        }
        int reached = 0;
        for (const glm::vec4& pixel : image.pixels())
            reached += pixel.r > 0.0f;
        CHECK(reached == (kernel == Kernel::B3Spline5x5 ? 125 : 63));
        CHECK(image({70 - reached / 2, 0}).r > 0.0f);
        CHECK(image({70 + reached / 2, 0}).r > 0.0f);
    }
}

TEST_CASE("a constant picture stays constant, whatever the surfaces") {
    RandomFrame frame({31, 23}, 3);
    const glm::vec4 constant(0.3f, 0.5f, 0.7f, 0.04f);
    fill(frame.signal, constant);
    for (const Kernel kernel : kKernels)
        for (const int step : {1, 4}) {
            gpu::EdgeStopping params = kSvgf;
            params.step = step;
            const auto filtered =
                reference::atrous(frame.signal, frame.guides, frame.slope, kernel, params);
            for (const glm::dvec4& pixel : filtered.pixels()) {
                CHECK(glm::distance(glm::dvec3(pixel), glm::dvec3(constant)) < 1e-12);
                CHECK(pixel.a <= double(constant.a)); // an average has no more variance
            }
        }
}

TEST_CASE("averaging equal pixels of a wall divides their variance by the kernel's sample count") {
    const Wall wall({9, 9});
    const Image<glm::vec4> image({9, 9}, glm::vec4(1, 1, 1, 1));
    const auto inside = [&](Kernel kernel) {
        return reference::atrous(image, wall.guides, wall.slope, kernel, kSvgf)({4, 4}).a;
    };
    CHECK(inside(Kernel::Box3x3) == doctest::Approx(1.0 / 9.0));
    const double inX = (2 * 1.0 + 2 * 16.0 + 36.0) / 256.0; // squares of the spline's shares
    CHECK(inside(Kernel::B3Spline5x5) == doctest::Approx(inX * inX));
}

TEST_CASE("the filter does not see the unit of length") {
    const RandomFrame frame({31, 23}, 4);
    RandomFrame inMillimetres = frame;
    for (glm::vec4& guide : inMillimetres.guides.pixels())
        guide.w *= 1024.0f; // a power of two: exact
    for (glm::vec2& slope : inMillimetres.slope.pixels())
        slope *= 1024.0f;
    const auto a =
        reference::atrous(frame.signal, frame.guides, frame.slope, Kernel::B3Spline5x5, kSvgf);
    const auto b = reference::atrous(inMillimetres.signal, inMillimetres.guides,
                                     inMillimetres.slope, Kernel::B3Spline5x5, kSvgf);
    for (std::size_t i = 0; i < a.pixels().size(); ++i)
        CHECK(glm::distance(a.pixels()[i], b.pixels()[i]) < 1e-9);
}

TEST_CASE("with alpha 1, or with lambda 1, the temporal stage returns its input") {
    for (const bool byLambda : {false, true}) {
        RandomFrame frame({31, 23}, 5);
        gpu::TemporalParams params = kTemporal;
        if (byLambda)
            fill(frame.lambda, 1.0f);
        else
            params.alpha = params.alphaMoments = 1.0f;
        const auto result =
            reference::temporal({frame.raw, frame.visibility, frame.previousVisibility,
                                 frame.guides, frame.previousGuides, frame.slope, frame.motion,
                                 frame.previousColor, frame.previousMoments, frame.lambda, true},
                                params);
        for (int i = 0; i < int(frame.raw.pixels().size()); ++i) {
            const glm::dvec4 raw(frame.raw.pixels()[i]);
            const bool isForeground = frame.guides.pixels()[i].w != 0.0f;
            CHECK(glm::dvec3(result.accumulated.pixels()[i]) == glm::dvec3(raw));
            CHECK(result.moments.pixels()[i].x == raw.a);
            CHECK(result.moments.pixels()[i].y == raw.a * raw.a);
            CHECK(result.moments.pixels()[i].z == doctest::Approx(isForeground ? 1.0 : 0.0));
        }
    }
}

TEST_CASE("plain averaging lengthens the history by one frame, a reset makes it one") {
    for (const int law : {gpu::kHistoryEffective, gpu::kHistoryFrames, gpu::kHistoryPower})
        for (const double n : {1.0, 2.0, 3.5, 10.0, 200.0})
            CHECK(reference::nextLength(law, n, 1.0 / (n + 1.0)) ==
                  doctest::Approx(n + 1.0).epsilon(1e-12));
    CHECK(reference::nextLength(gpu::kHistoryEffective, 57.0, 1.0) == doctest::Approx(1.0));
    // This law does not know lambda: that is its fault, and why the others exist.
    CHECK(reference::nextLength(gpu::kHistoryFrames, 57.0, 1.0) == 58.0);
}

TEST_CASE("the history law power shortens the history in the frame of the change") {
    Wall wall({3, 3});
    fill(wall.moments, glm::vec4(0.0f, 0.0f, 57.0f, 0.0f));
    fill(wall.lambda, 0.25f);
    gpu::TemporalParams params = kTemporal;
    params.alpha = params.alphaMoments = 0.0f;
    params.historyLaw = gpu::kHistoryPower;
    const double kept = 57.0 * std::pow(0.75, 10.0);
    const auto changed = wall.temporal(params);
    CHECK(changed.control({1, 1}).y == doctest::Approx(0.75 / (kept + 1.0) + 0.25));
    CHECK(changed.moments({1, 1}).z == doctest::Approx(kept + 1.0));
    fill(wall.lambda, 1.0f);
    CHECK(wall.temporal(params).moments({1, 1}).z == 1.0);
}

TEST_CASE("the effective length of an exponential average settles at 2 / alpha - 1") {
    double length = 1.0;
    for (int i = 0; i < 2000; ++i)
        length = reference::nextLength(gpu::kHistoryEffective, length,
                                       std::max(0.1, 1.0 / (length + 1.0)));
    CHECK(length == doctest::Approx(19.0));
}

TEST_CASE("a still wall averages its frames exactly until alpha takes over") {
    Wall wall({5, 4});
    gpu::TemporalParams params = kTemporal;
    params.alpha = params.alphaMoments = 0.01f;
    double sum = 0.0, squares = 0.0;
    for (int n = 1; n <= 20; ++n) {
        const float l = float(n % 7); // exact in 32 bits
        sum += l;
        squares += l * l;
        fill(wall.raw, glm::vec4(l));
        const auto result = wall.temporal(params);
        for (std::size_t i = 0; i < wall.raw.pixels().size(); ++i) {
            CHECK(result.accumulated.pixels()[i].r == doctest::Approx(sum / n).epsilon(1e-5));
            CHECK(result.moments.pixels()[i].x == doctest::Approx(sum / n).epsilon(1e-5));
            CHECK(result.moments.pixels()[i].y == doctest::Approx(squares / n).epsilon(1e-5));
            CHECK(result.moments.pixels()[i].z == doctest::Approx(n).epsilon(1e-5));
        }
        wall.color = toFloat(result.accumulated);
        wall.moments = toFloat(result.moments);
    }
}

TEST_CASE("each way to fetch lambda returns a constant as it is, and bilinear meets the centers") {
    Image<float> lambda({4, 3}, 0.25f);
    for (const int fetch : {gpu::kLambdaNearest, gpu::kLambdaBilinear, gpu::kLambdaMax})
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 12; ++x)
                CHECK(reference::fetchLambda(lambda, {x, y}, fetch) == doctest::Approx(0.25));
    lambda({2, 1}) = 1.0f;
    const auto bilinear = [&](glm::ivec2 p) {
        return reference::fetchLambda(lambda, p, gpu::kLambdaBilinear);
    };
    CHECK(bilinear({7, 4}) == doctest::Approx(1.0)); // the middle pixel of stratum (2, 1)
    CHECK(bilinear({6, 4}) == doctest::Approx(0.25 + 0.75 * 2.0 / 3.0));
    CHECK(bilinear({8, 5}) == doctest::Approx(0.25 + 0.75 * 4.0 / 9.0));
    CHECK(bilinear({4, 4}) == doctest::Approx(0.25));
}

TEST_CASE("variance is never negative, and background has none") {
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        const RandomFrame frame({31, 23}, seed);
        const auto result = reference::variance(
            {frame.accumulated, frame.moments, frame.guides, frame.slope}, kVariance);
        int positive = 0;
        for (std::size_t i = 0; i < result.pixels().size(); ++i) {
            CHECK(result.pixels()[i].a >= 0.0);
            positive += result.pixels()[i].a > 0.0;
            if (frame.guides.pixels()[i].w == 0.0f)
                CHECK(result.pixels()[i] == glm::dvec4(0.0));
        }
        CHECK(positive > 300);
    }
}

TEST_CASE("on a wall the spatial variance is the variance of the picture, times four over N") {
    Wall wall({7, 7});
    double mean = 0.0, square = 0.0;
    for (int y = 0; y < 7; ++y)
        for (int x = 0; x < 7; ++x) {
            const float l = float((3 * x + 5 * y) % 4);
            wall.moments({x, y}) = glm::vec4(l, l * l, 2.0f, 0.0f);
            mean += l / 49.0;
            square += l * l / 49.0;
        }
    const auto result =
        reference::variance({wall.color, wall.moments, wall.guides, wall.slope}, kVariance);
    CHECK(result({3, 3}).a == doctest::Approx(2.0 * (square - mean * mean)));
}

TEST_CASE("a still scene has no gradient and no lambda, after any number of iterations") {
    RandomFrame frame({31, 23}, 6);
    for (int y = 0; y < frame.strata.y; ++y)
        for (int x = 0; x < frame.strata.x; ++x)
            if (glm::uvec4& sample = frame.samples({x, y}); sample.y != 0) {
                const int landing = int(sample.y) - 1;
                const glm::ivec2 p = 3 * glm::ivec2(x, y) + glm::ivec2(landing % 3, landing / 3);
                sample.z = std::uint32_t(p.x) | std::uint32_t(p.y) << 16;
            }
    const auto strata = reference::strataGuides(frame.guides, frame.slope);
    Image<glm::vec4> gradient = toFloat(reference::gradient(
        {frame.raw, frame.raw, frame.samples, frame.guides}, gradientParams(1e-4f, -1.0f)));
    for (const int step : {1, 2, 4, 8, 16}) {
        gpu::EdgeStopping params = kSvgf;
        params.step = step;
        gradient = toFloat(reference::gradientAtrous(gradient, strata.guides, strata.slope,
                                                     Kernel::Box3x3, params));
    }
    const auto lambda = reference::lambda(gradient, gradientParams(1e-4f, -1.0f));
    double largest = 0.0;
    for (std::size_t i = 0; i < lambda.pixels().size(); ++i) {
        CHECK(gradient.pixels()[i].x == 0.0f);
        CHECK(lambda.pixels()[i] == 0.0);
        largest = std::max(largest, double(gradient.pixels()[i].y));
    }
    CHECK(largest > 0.1); // there was light to compare
}

TEST_CASE("lambda is 1 where all light went out, one half where half did, and can be forced") {
    Image<glm::vec4> gradient({3, 1});
    gradient({0, 0}) = glm::vec4(-0.8f, 0.8f, 0, 0);
    gradient({1, 0}) = glm::vec4(0.4f, 0.8f, 0, 0);
    gradient({2, 0}) = glm::vec4(-1e-5f, 1e-5f, 0, 0);
    const auto measured = reference::lambda(gradient, gradientParams(1e-4f, -1));
    CHECK(measured({0, 0}) == 1.0);
    CHECK(measured({1, 0}) == doctest::Approx(0.5));
    CHECK(measured({2, 0}) == 0.0);
    for (const float forced : {0.0f, 0.5f, 1.0f}) {
        const auto result = reference::lambda(gradient, gradientParams(1e-4f, forced));
        for (const double value : result.pixels())
            CHECK(value == double(forced));
    }
}

TEST_CASE("a random frame shows every case, and no validity test is near its threshold") {
    int reasons[6] = {};
    int background = 0, samples = 0, empties = 0;
    double margin = 1.0;
    for (const std::uint32_t seed : {1u, 2u, 3u, 4u})
        for (const float depthTolerance : {1.0f, 4.0f})
            for (const float normalTolerance : {0.3f, 0.95f}) {
                const RandomFrame frame({61, 37}, seed);
                gpu::TemporalParams params = kTemporal;
                params.depthTolerance = depthTolerance;
                params.normalTolerance = normalTolerance;
                const auto result = reference::temporal(
                    {frame.raw, frame.visibility, frame.previousVisibility, frame.guides,
                     frame.previousGuides, frame.slope, frame.motion, frame.previousColor,
                     frame.previousMoments, frame.lambda, true},
                    params);
                margin = std::min(margin, result.margin);
                for (std::size_t i = 0; i < frame.guides.pixels().size(); ++i)
                    if (frame.guides.pixels()[i].w == 0.0f)
                        ++background;
                    else
                        ++reasons[int(result.control.pixels()[i].w)];
                for (const glm::uvec4& sample : frame.samples.pixels())
                    ++(sample.y == 0 ? empties : samples);
            }
    MESSAGE("kept ", reasons[0], ", off-screen ", reasons[2], ", instance ", reasons[3], ", depth ",
            reasons[4], ", normal ", reasons[5], ", background ", background, ", samples ", samples,
            ", empty ", empties, ", margin ", margin);
    CHECK(margin > 1e-4);
    CHECK(reasons[gpu::kHistoryKept] > 5000);
    CHECK(reasons[gpu::kHistoryNone] == 0);
    for (const int reason :
         {gpu::kHistoryOffScreen, gpu::kHistoryInstance, gpu::kHistoryDepth, gpu::kHistoryNormal})
        CHECK(reasons[reason] > 100);
    CHECK(background > 1000);
    CHECK(samples > 1000);
    CHECK(empties > 500);
}
