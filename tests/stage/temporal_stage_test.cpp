// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <vector>

#include "tests/reference/temporal.h"
#include "tests/stage/stage_runner.h"
#include "tests/stage/temporal_check.h"
#include "tests/support/compare.h"
#include "tests/support/gl_fixture.h"

using namespace afterglow;
using namespace afterglow::test;

namespace {

// llvmpipe: 4e-6, in the history length, a quotient of small differences; the rest is for pow() and
// divisions on GPUs.
constexpr Tolerance kTolerance{.max = 2e-5, .relative = 2e-5};

const gpu::TemporalParams kParams{.alpha = 0.1f,
                                  .alphaMoments = 0.2f,
                                  .maxHistory = 64.0f,
                                  .depthTolerance = 2.0f,
                                  .normalTolerance = 0.9f,
                                  .lambdaFetch = gpu::kLambdaBilinear,
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

reference::TemporalResult expect(const RandomFrame& frame, bool historyValid,
                                 const gpu::TemporalParams& params) {
    const Image<glm::vec4> ranges = luminanceRanges(frame);
    return reference::temporal({frame.raw, frame.visibility, frame.previousVisibility, frame.guides,
                                frame.previousGuides, frame.slope, frame.motion,
                                frame.previousColor, frame.previousMoments, frame.lambda,
                                historyValid, &ranges},
                               params);
}

/// Plans that use each choice at least once. The frame's pass is compiled for a plan; where a pixel
/// is inspected, the same program serves them all.
std::vector<gpu::TemporalParams> plans() {
    std::vector<gpu::TemporalParams> all;
    const auto add = [&](auto change) {
        all.push_back(kParams);
        change(all.back());
    };
    for (const int choice : {0, 1, 2}) { // of three
        add([&](gpu::TemporalParams& p) { p.lambdaFetch = p.historyLaw = choice; });
        add([&](gpu::TemporalParams& p) {
            p.lambdaSource = gpu::kLambdaFromNothing;
            p.historyLaw = choice;
        });
        add([&](gpu::TemporalParams& p) {
            p.lambdaSource = gpu::kLambdaFromRange;
            p.historyLaw = choice;
        });
    }
    add([](gpu::TemporalParams& p) { p.lambdaUse = gpu::kLambdaCuts; });
    add([](gpu::TemporalParams& p) {
        p.lambdaSource = gpu::kLambdaFromRange;
        p.lambdaUse = gpu::kLambdaCuts;
    });
    add([](gpu::TemporalParams& p) { p.clampRadius = 1; });
    add([](gpu::TemporalParams& p) {
        p.lambdaSource = gpu::kLambdaFromNothing;
        p.clampRadius = 0;
    });
    return all;
}

/// The largest difference in color and moments (first) and in control (second).
glm::dvec2 checkTemporal(const RandomFrame& frame, bool historyValid,
                         const gpu::TemporalParams& params) {
    const auto images = runTemporal(testShaders(), frame, historyValid, params);
    const auto expected = expect(frame, historyValid, params);
    return checkTemporalImages(images, expected, kTolerance);
}

} // namespace

TEST_CASE("temporal accumulation follows the papers, for every size, history law and fetch") {
    glm::dvec2 largest(0.0);
    for (const glm::ivec2 size : kStageSizes)
        for (const std::uint32_t seed : {7u, 8u, 9u})
            for (const int law : {gpu::kHistoryEffective, gpu::kHistoryFrames, gpu::kHistoryPower})
                for (const int fetch :
                     {gpu::kLambdaNearest, gpu::kLambdaBilinear, gpu::kLambdaMax}) {
                    CAPTURE(size.x);
                    CAPTURE(size.y);
                    CAPTURE(seed);
                    CAPTURE(law);
                    CAPTURE(fetch);
                    gpu::TemporalParams params = kParams;
                    params.historyLaw = law;
                    params.lambdaFetch = fetch;
                    largest =
                        glm::max(largest, checkTemporal(RandomFrame(size, seed), true, params));
                }
    MESSAGE("largest difference: ", largest.x, ", in control ", largest.y);
}

TEST_CASE("temporal accumulation follows the papers, for tight and loose parameters") {
    glm::dvec2 largest(0.0);
    const RandomFrame frame({61, 37}, 11);
    for (const float alpha : {0.0f, 0.3f, 1.0f})
        for (const float maxHistory : {1.0f, 5.0f, 256.0f})
            for (const float depthTolerance : {1.0f, 4.0f})
                for (const float normalTolerance : {0.3f, 0.95f}) {
                    CAPTURE(alpha);
                    CAPTURE(maxHistory);
                    CAPTURE(depthTolerance);
                    CAPTURE(normalTolerance);
                    gpu::TemporalParams params = kParams;
                    params.alpha = alpha;
                    params.alphaMoments = 1.0f - alpha;
                    params.maxHistory = maxHistory;
                    params.depthTolerance = depthTolerance;
                    params.normalTolerance = normalTolerance;
                    largest = glm::max(largest, checkTemporal(frame, true, params));
                }
    MESSAGE("largest difference: ", largest.x, ", in control ", largest.y);
}

TEST_CASE("without lambda only alpha counts, without a previous frame only the new one") {
    glm::dvec2 largest(0.0);
    for (const bool historyValid : {false, true})
        for (const int source : {gpu::kLambdaFromNothing, gpu::kLambdaFromGradient}) {
            CAPTURE(historyValid);
            CAPTURE(source);
            gpu::TemporalParams params = kParams;
            params.lambdaSource = source;
            largest =
                glm::max(largest, checkTemporal(RandomFrame({61, 37}, 12), historyValid, params));
        }
    MESSAGE("largest difference: ", largest.x, ", in control ", largest.y);
}

TEST_CASE("the reason for losing history is told exactly") {
    for (const std::uint32_t seed : {13u, 14u}) {
        const RandomFrame frame({61, 37}, seed);
        const auto images = runTemporal(testShaders(), frame, true, kParams);
        const auto expected = expect(frame, true, kParams);
        int lost = 0;
        for (std::size_t i = 0; i < frame.guides.pixels().size(); ++i) {
            CHECK(double(images.control.pixels()[i].w) == expected.control.pixels()[i].w);
            lost += expected.control.pixels()[i].w != gpu::kHistoryKept;
        }
        CHECK(lost > 50);
    }
}

TEST_CASE(
    "inspected, the temporal pass computes at every pixel the bits that it has in the frame") {
    const GlCheck noGlMessages;
    const std::vector<gpu::TemporalParams> all = plans();
    for (const bool historyValid : {true, false})
        for (const gpu::TemporalParams& params : all) {
            const RandomFrame frame({61, 37}, 15);
            TemporalFindings findings;
            const auto images = runTemporal(testShaders(), frame, historyValid, params, &findings);
            REQUIRE(findings.size() == 61 * 37);
            for (std::size_t i = 0; i < findings.size(); ++i) {
                CAPTURE(i);
                CHECK(findings[i].texel == glm::ivec2(i % 61, i / 61));
                CHECK(findings[i].accumulated == images.accumulated.pixels()[i]);
                CHECK(findings[i].moments == images.moments.pixels()[i]);
                CHECK(findings[i].control == images.control.pixels()[i]);
            }
        }
}

TEST_CASE("what the temporal pass computes on its way is what the reference finds there") {
    const GlCheck noGlMessages;
    const RandomFrame frame({61, 37}, 16);
    const Image<glm::vec4> ranges = luminanceRanges(frame);
    const reference::TemporalInputs in{frame.raw,
                                       frame.visibility,
                                       frame.previousVisibility,
                                       frame.guides,
                                       frame.previousGuides,
                                       frame.slope,
                                       frame.motion,
                                       frame.previousColor,
                                       frame.previousMoments,
                                       frame.lambda,
                                       true,
                                       &ranges};
    gpu::TemporalParams params = kParams;
    params.clampRadius = 1;
    params.lambdaSource = gpu::kLambdaFromRange;
    TemporalFindings findings;
    runTemporal(testShaders(), frame, true, params, &findings);
    const auto isClose = [](auto a, auto b) {
        return glm::all(glm::lessThan(glm::abs(glm::dvec3(a) - glm::dvec3(b)), glm::dvec3(2e-5)));
    };
    double margin = 1.0;
    int surfaces = 0, kept = 0, clamped = 0, outside = 0;
    for (std::size_t i = 0; i < findings.size(); ++i) {
        CAPTURE(i);
        const gpu::TemporalFindings& found = findings[i];
        const glm::ivec2 p = found.texel;
        if (reference::isBackground(frame.guides(p)) || frame.motion(p).w == 0.0f) {
            CHECK(found.taps[0].weight + found.taps[3].weight == 0.0f);
            continue;
        }
        ++surfaces;
        const glm::dvec2 position = glm::clamp(glm::dvec2(p) + glm::dvec2(frame.motion(p)),
                                               glm::dvec2(-4.0), glm::dvec2(frame.size) + 4.0);
        CHECK(isClose(glm::dvec3(found.position, 0.0), glm::dvec3(position, 0.0)));
        CHECK(found.depth == frame.motion(p).z);
        for (const gpu::HistoryTap& tap : found.taps) {
            CHECK(tap.reason == reference::judgeTap(in, params, p, tap.pixel, margin));
            const glm::dvec2 off = glm::abs(glm::dvec2(tap.pixel) - position);
            CHECK(std::abs(tap.weight - (1.0 - off.x) * (1.0 - off.y)) < 2e-5);
        }
        const reference::History history = reference::findHistory(in, params, p, margin);
        CHECK(isClose(found.fetchedColor, history.color));
        CHECK(isClose(glm::dvec3(found.fetchedMoments, found.fetchedSamples),
                      glm::dvec3(history.moments, history.length)));
        CHECK(isClose(found.usedColor, reference::clampHistory(in, params, p, history.color)));
        kept += history.length > 0.0;
        clamped += found.usedColor != found.fetchedColor;
        outside += found.outside > 0.0f;
    }
    CHECK(margin > 1e-4);
    CHECK(surfaces > 1000);
    CHECK(kept > 500);
    CHECK(clamped > 100);
    CHECK(outside > 100);
}
