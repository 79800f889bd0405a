// SPDX-License-Identifier: MIT
// The counted history, lambda fetched by light, and the variance of a mean.

#include <doctest/doctest.h>

#include <limits>

#include "tests/reference/variance.h"
#include "tests/stage/counted.h"
#include "tests/stage/temporal_check.h"
#include "tests/support/compare.h"
#include "tests/support/gl_fixture.h"

using namespace afterglow;
using namespace afterglow::test;

namespace {

// llvmpipe: 2.5e-5, where N is below 1/100 and w is 1 - N / N_f; elsewhere 5e-6.
constexpr Tolerance kTolerance{.max = 4e-5, .relative = 2e-5};
// As in variance_stage_test.cpp.
constexpr Tolerance kVarianceTolerance{.max = 3e-5, .relative = 3e-5};

/// Returns the largest difference.
double checkCounted(const RandomFrame& frame, const gpu::TemporalParams& params,
                    bool historyValid = true) {
    const TemporalImages images = runTemporal(testShaders(), frame, historyValid, params);
    const auto expected = expectCounted(frame, params, historyValid);
    return glm::compMax(checkTemporalImages(images, expected, kTolerance));
}

bool isLanding(const RandomFrame& frame, glm::ivec2 p) {
    return frame.samples(p / 3).y != 0 && reference::landingOf(frame.samples, p / 3) == p;
}

/// Returns the pixel of the frame before, all of which pixel p takes over; nothing where it takes
/// less, or more.
std::optional<glm::ivec2> wholeHistory(const RandomFrame& frame, const TemporalImages& images,
                                       glm::ivec2 p) {
    const glm::vec2 position = glm::vec2(p) + glm::vec2(frame.motion(p));
    const bool kept = frame.guides(p).w != 0.0f && images.control(p).w == gpu::kHistoryKept;
    if (!kept || position != glm::floor(position))
        return {};
    return glm::ivec2(position);
}

} // namespace

TEST_CASE("the counted history follows the text, at every size, by every fetch") {
    double largest = 0.0;
    for (const glm::ivec2 size : kStageSizes)
        for (const std::uint32_t seed : {7u, 8u})
            for (const std::uint32_t changed : {0u, 1u, 2u, 100u})
                for (const gpu::TemporalParams& params : countedPlans()) {
                    CAPTURE(size.x);
                    CAPTURE(size.y);
                    CAPTURE(seed);
                    CAPTURE(changed);
                    CAPTURE(params.lambdaFetch);
                    CAPTURE(params.lambdaUse);
                    CAPTURE(params.clampRadius);
                    if (params.lambdaUse != gpu::kLambdaCounts && changed > 0)
                        continue; // that does not ask how many
                    largest =
                        std::max(largest, checkCounted(countedFrame(size, seed, changed), params));
                }
    MESSAGE("largest difference: ", largest);
}

TEST_CASE("the counted history follows the text, for tight and loose parameters") {
    double largest = 0.0;
    for (const std::uint32_t changed : {1u, 100u}) {
        const RandomFrame frame = countedFrame({61, 37}, 11, changed);
        for (const float reactivity : {0.0f, 1.0f, 50.0f})
            for (const float length : {1.0f, 1000.0f})
                for (const int once : {0, 1}) {
                    CAPTURE(reactivity);
                    CAPTURE(length);
                    CAPTURE(once);
                    gpu::TemporalParams params = kCounts;
                    params.reactivity = reactivity;
                    params.historyDuringChange = length;
                    params.historyBetweenPixels = 2.0f * length;
                    params.countReusedOnce = once;
                    largest = std::max(largest, checkCounted(frame, params));
                }
    }
    largest = std::max(largest, checkCounted(countedFrame({61, 37}, 12, 100), kCounts, false));
    MESSAGE("largest difference: ", largest);
}

TEST_CASE("a reused sample whose light has not changed leaves the history as it is, bit for bit; "
          "any other one is one sample more") {
    int reused = 0, others = 0;
    for (const std::uint32_t seed : {13u, 14u, 16u, 17u}) {
        RandomFrame frame({61, 37}, seed);
        frame.changed = seed % 2; // of one stratum, somewhere else
        for (float& lambda : frame.lambda.pixels())
            lambda = 0.0f;
        for (glm::vec4& change : frame.change.pixels())
            change.x = 0.0f; // a factor without lambda has no effect
        const TemporalImages images = runTemporal(testShaders(), frame, true, kCounts);
        for (int y = 0; y < frame.size.y; ++y)
            for (int x = 0; x < frame.size.x; ++x) {
                const glm::ivec2 p{x, y};
                const auto source = wholeHistory(frame, images, p);
                if (!source || frame.previousMoments(*source).z == 0.0f)
                    continue;
                CAPTURE(x);
                CAPTURE(y);
                const glm::vec4 control = images.control(p);
                const float n = frame.previousMoments(*source).z;
                if (isLanding(frame, p)) {
                    CHECK(control.y == 0.0f);
                    CHECK(control.z == n);
                    CHECK(glm::vec3(images.accumulated(p)) ==
                          glm::vec3(frame.previousColor(*source)));
                    ++reused;
                } else {
                    CHECK(control.y == 1.0f / (n + 1.0f));
                    CHECK(control.z == n + 1.0f);
                    ++others;
                }
                CHECK(images.moments(p).z == control.z);
            }
    }
    CHECK(reused > 50);
    CHECK(others > 500);
}

TEST_CASE("where no light has changed in the frame, nothing that is said of a change has effect") {
    for (gpu::TemporalParams params : countedPlans()) {
        if (params.lambdaUse != gpu::kLambdaCounts)
            continue;
        RandomFrame frame = countedFrame({61, 37}, 14, 0);
        const TemporalImages images = runTemporal(testShaders(), frame, true, params);
        for (glm::vec4& change : frame.change.pixels())
            change = glm::vec4(std::numeric_limits<float>::quiet_NaN());
        const TemporalImages others = runTemporal(testShaders(), frame, true, params);
        CHECK_CLOSE(others.accumulated, images.accumulated, Tolerance{});
        CHECK_CLOSE(others.moments, images.moments, Tolerance{});
        CHECK_CLOSE(others.control, images.control, Tolerance{});
    }
}

TEST_CASE("inspected, a counted history has at every pixel the bits that it has in the frame") {
    const GlCheck noGlMessages;
    for (const std::uint32_t changed : {0u, 100u})
        for (const gpu::TemporalParams& params : countedPlans()) {
            const RandomFrame frame = countedFrame({23, 14}, 15, changed);
            TemporalFindings findings;
            const auto images = runTemporal(testShaders(), frame, true, params, &findings);
            REQUIRE(findings.size() == 23 * 14);
            for (std::size_t i = 0; i < findings.size(); ++i) {
                CAPTURE(i);
                CAPTURE(params.lambdaFetch);
                CHECK(findings[i].accumulated == images.accumulated.pixels()[i]);
                CHECK(findings[i].moments == images.moments.pixels()[i]);
                CHECK(findings[i].control == images.control.pixels()[i]);
            }
        }
}

TEST_CASE("the variance of a mean falls with the power that is set, and is raised while short") {
    double largest = 0.0;
    for (const glm::ivec2 size : kStageSizes)
        for (const std::uint32_t seed : {7u, 8u})
            for (const float exponent : {0.0f, 1.0f, 1.25f})
                for (const float boost : {0.0f, 3.0f})
                    for (const float minHistory : {0.0f, 4.0f}) {
                        CAPTURE(size.x);
                        CAPTURE(size.y);
                        CAPTURE(seed);
                        CAPTURE(exponent);
                        CAPTURE(boost);
                        CAPTURE(minHistory);
                        const RandomFrame frame(size, seed);
                        const gpu::VarianceParams params{32.0f, 1.0f, minHistory, exponent,
                                                         boost, 0.0f, 0.0f,       0.0f};
                        const auto filtered = runVariance(testShaders(), frame, params);
                        const auto expected = reference::variance(
                            {frame.accumulated, frame.moments, frame.guides, frame.slope}, params);
                        CHECK_CLOSE(filtered, expected, kVarianceTolerance);
                        largest = std::max(largest,
                                           compare(filtered, expected, kVarianceTolerance).largest);
                    }
    MESSAGE("largest difference: ", largest);
}
