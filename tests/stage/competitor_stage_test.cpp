// SPDX-License-Identifier: MIT
// What the competing filters add to the shared stages: a clamped history, lambda from percentiles
// of one frame, lambda that cuts the history length.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "tests/reference/luminance_range.h"
#include "tests/stage/competitors.h"
#include "tests/stage/temporal_check.h"
#include "tests/support/compare.h"
#include "tests/support/gl_fixture.h"

using namespace afterglow;
using namespace afterglow::test;

namespace {

// llvmpipe: 6e-7; sums of 64 at most.
constexpr Tolerance kRangeTolerance{.max = 2e-6, .relative = 2e-6};
// llvmpipe: 2e-5, in the history length, a quotient of small differences; see
// temporal_stage_test.cpp. The rest is for divisions on GPUs.
constexpr Tolerance kTolerance{.max = 3e-5, .relative = 3e-5};

/// The largest difference.
double checkTemporal(const RandomFrame& frame, const gpu::TemporalParams& params) {
    const auto images = runTemporal(testShaders(), frame, true, params);
    const auto expected = expect(frame, params);
    return glm::compMax(checkTemporalImages(images, expected, kTolerance));
}

int foregroundOf(const RandomFrame& frame) {
    return int(std::ranges::count_if(frame.guides.pixels(),
                                     [](const glm::vec4& guide) { return guide.w != 0.0f; }));
}

} // namespace

TEST_CASE("the luminance range holds the percentiles of each tile and its mean, at every size") {
    double largest = 0.0;
    for (const glm::ivec2 size : kStageSizes)
        for (const std::uint32_t seed : {7u, 8u, 9u})
            for (const gpu::PercentileParams& params : kPercentiles) {
                CAPTURE(size.x);
                CAPTURE(size.y);
                CAPTURE(seed);
                CAPTURE(params.lowPercentile);
                const RandomFrame frame(size, seed);
                const auto range = runLuminanceRange(testShaders(), frame, params);
                const auto expected = reference::luminanceRange(frame.raw, frame.guides, params);
                CHECK_CLOSE(range, expected, kRangeTolerance);
                largest = std::max(largest, compare(range, expected, kRangeTolerance).largest);
            }
    MESSAGE("largest difference: ", largest);
}

TEST_CASE("percentiles 0 and 1 are the least and the largest value, bit for bit, equal ones too") {
    RandomFrame frame({61, 37}, 7);
    for (glm::vec4& value : frame.raw.pixels()) // many equal values
        value = glm::vec4(std::round(4.0f * value.a) / 4.0f);
    const auto ranges = runLuminanceRange(testShaders(), frame, {0.0f, 1.0f, 0.0f, 0.0f});
    int whole = 0;
    for (int ty = 0; ty < ranges.size().y; ++ty)
        for (int tx = 0; tx < ranges.size().x; ++tx) {
            std::vector<float> values;
            for (int y = 8 * ty; y < std::min(8 * ty + 8, frame.size.y); ++y)
                for (int x = 8 * tx; x < std::min(8 * tx + 8, frame.size.x); ++x)
                    if (frame.guides({x, y}).w != 0.0f)
                        values.push_back(frame.raw({x, y}).a);
            const glm::vec4 range = ranges({tx, ty});
            CHECK(range.z == float(values.size()));
            CHECK(range.x == (values.empty() ? 0.0f : *std::ranges::min_element(values)));
            CHECK(range.y == (values.empty() ? 0.0f : *std::ranges::max_element(values)));
            whole += values.size() == 64;
        }
    CHECK(whole > 0);
}

TEST_CASE("a history is clamped to the raw signal around it, at every size and radius") {
    double largest = 0.0;
    for (const glm::ivec2 size : kStageSizes)
        for (const std::uint32_t seed : {7u, 8u})
            for (const int radius : {0, 1, 2, 5})
                for (const float sigmas : {0.25f, 1.0f, 3.0f}) {
                    CAPTURE(size.x);
                    CAPTURE(size.y);
                    CAPTURE(seed);
                    CAPTURE(radius);
                    CAPTURE(sigmas);
                    largest = std::max(
                        largest, checkTemporal(RandomFrame(size, seed), clamped(radius, sigmas)));
                }
    MESSAGE("largest difference: ", largest);
}

TEST_CASE("a wide clamp leaves every history as it is, bit for bit; a narrow one leaves few") {
    const RandomFrame frame({61, 37}, 7);
    const auto plain = runTemporal(testShaders(), frame, true, kPlain).accumulated;
    const auto changed = [&](float sigmas) {
        const auto images = runTemporal(testShaders(), frame, true, clamped(2, sigmas));
        int count = 0;
        for (std::size_t i = 0; i < plain.pixels().size(); ++i) {
            const glm::vec4& a = plain.pixels()[i];
            const glm::vec4& b = images.accumulated.pixels()[i];
            CHECK(a.a == b.a); // the luminance of the history as it was fetched
            count += std::memcmp(&a, &b, sizeof a) != 0;
        }
        return count;
    };
    CHECK(changed(1000.0f) < foregroundOf(frame) / 100); // all but where nothing varies
    CHECK(changed(0.1f) > foregroundOf(frame) / 2);
}

TEST_CASE("lambda follows the distance of the history from the luminance range, at every size") {
    double largest = 0.0;
    for (const glm::ivec2 size : kStageSizes)
        for (const std::uint32_t seed : {7u, 8u})
            for (const float slope : {0.25f, 1.0f, 4.0f}) {
                CAPTURE(size.x);
                CAPTURE(size.y);
                CAPTURE(seed);
                CAPTURE(slope);
                gpu::TemporalParams params = adaptive(gpu::kLambdaFromRange, gpu::kLambdaBlends);
                params.percentileSlope = slope;
                largest = std::max(largest, checkTemporal(RandomFrame(size, seed), params));
            }
    MESSAGE("largest difference: ", largest);

    const RandomFrame frame({61, 37}, 7);
    gpu::TemporalParams steep = adaptive(gpu::kLambdaFromRange, gpu::kLambdaBlends);
    steep.percentileSlope = 4.0f;
    const auto control = runTemporal(testShaders(), frame, true, steep).control;
    int inside = 0, between = 0, outside = 0;
    for (std::size_t i = 0; i < control.pixels().size(); ++i) {
        if (frame.guides.pixels()[i].w == 0.0f || control.pixels()[i].w != float(gpu::kHistoryKept))
            continue;
        const float lambda = control.pixels()[i].x;
        ++(lambda == 0.0f ? inside : lambda == 1.0f ? outside : between);
    }
    CHECK(inside > 100);
    CHECK(between > 100);
    CHECK(outside > 20);
}

TEST_CASE("a confidence below 1 cuts the history for good, for every law and source of lambda") {
    double largest = 0.0;
    for (const glm::ivec2 size : kStageSizes)
        for (const std::uint32_t seed : {7u, 8u})
            for (const int law : {gpu::kHistoryEffective, gpu::kHistoryFrames, gpu::kHistoryPower})
                for (const int source : {gpu::kLambdaFromGradient, gpu::kLambdaFromRange}) {
                    CAPTURE(size.x);
                    CAPTURE(size.y);
                    CAPTURE(seed);
                    CAPTURE(law);
                    CAPTURE(source);
                    largest =
                        std::max(largest, checkTemporal(RandomFrame(size, seed),
                                                        adaptive(source, gpu::kLambdaCuts, law)));
                }
    MESSAGE("largest difference: ", largest);
}

TEST_CASE(
    "a confidence of 1 changes nothing, bit for bit; a confidence of 0 leaves under a frame") {
    RandomFrame frame({61, 37}, 7);
    const auto plain = runTemporal(testShaders(), frame, true, kPlain);
    const auto run = [&](float lambda) {
        std::ranges::fill(frame.lambda.pixels(), lambda);
        return runTemporal(testShaders(), frame, true,
                           adaptive(gpu::kLambdaFromGradient, gpu::kLambdaCuts));
    };
    const auto sure = run(0.0f), unsure = run(1.0f);
    int kept = 0;
    for (std::size_t i = 0; i < plain.control.pixels().size(); ++i) {
        const auto isSame = [i](const Image<glm::vec4>& a, const Image<glm::vec4>& b) {
            return std::memcmp(&a.pixels()[i], &b.pixels()[i], sizeof(glm::vec4)) == 0;
        };
        CHECK(isSame(plain.accumulated, sure.accumulated));
        CHECK(isSame(plain.moments, sure.moments));
        CHECK(isSame(plain.control, sure.control));
        if (frame.guides.pixels()[i].w == 0.0f || plain.control.pixels()[i].y == 1.0f)
            continue;
        ++kept;
        // N / (N + 1) frames are left, so the newest weighs more than half and never all.
        CHECK(unsure.control.pixels()[i].y > 0.5f);
        CHECK(unsure.control.pixels()[i].y < 1.0f);
        CHECK(unsure.control.pixels()[i].z < 2.0f);
    }
    CHECK(kept > 500);
}
