// SPDX-License-Identifier: MIT
#pragma once

#include "tests/reference/change.h"
#include "tests/reference/temporal.h"
#include "tests/stage/stage_runner.h"

namespace afterglow::test {

// Shared by the tests of the counted history and by those of planted mistakes in it.

inline const gpu::TemporalParams kCounts{.alpha = 0.7f, // has no meaning here
                                         .alphaMoments = 0.2f,
                                         .maxHistory = 64.0f,
                                         .depthTolerance = 2.0f,
                                         .normalTolerance = 0.9f,
                                         .lambdaFetch = gpu::kLambdaLight,
                                         .historyLaw = gpu::kHistoryFrames,
                                         .lambdaSource = gpu::kLambdaFromGradient,
                                         .lambdaUse = gpu::kLambdaCounts,
                                         .percentileSlope = 1.0f,
                                         .clampSigmas = 1.0f,
                                         .clampRadius = -1,
                                         .reactivity = 5.0f,
                                         .historyDuringChange = 3.5f,
                                         .historyBetweenPixels = 2.5f,
                                         .countReusedOnce = 1};

inline constexpr gpu::ChangeParams changeParams(float deltaFloor, float forceLambda, int over,
                                                int scaleHistory, float scaleDoubt) {
    return {deltaFloor, forceLambda, over, scaleHistory, scaleDoubt, 0.0f, 0.0f, 0.0f};
}

/// Every choice, and floors below, amid and above the light that frames hold.
inline constexpr gpu::ChangeParams kChanges[] = {
    changeParams(1e-6f, -1.0f, gpu::kChangeOfChannels, 1, 4.0f),
    changeParams(1e-6f, -1.0f, gpu::kChangeOfChannels, 0, 4.0f),
    changeParams(1e-6f, -1.0f, gpu::kChangeOfLuminance, 1, 0.25f),
    changeParams(0.2f, -1.0f, gpu::kChangeOfLuminance, 1, 4.0f),
    changeParams(0.2f, -1.0f, gpu::kChangeOfChannels, 1, 0.0f),
    changeParams(1e-6f, 0.0f, gpu::kChangeOfChannels, 1, 4.0f),
    changeParams(1e-6f, 0.3f, gpu::kChangeOfLuminance, 1, 4.0f)};

/// Returns a frame in which some histories lie between pixels by just less, and by just more, than
/// counts as between.
inline RandomFrame countedFrame(glm::ivec2 size, std::uint32_t seed, std::uint32_t changed) {
    RandomFrame frame(size, seed);
    frame.changed = changed;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const float off[] = {0.0f, 0x1p-10f, -0x1p-10f, 0x1p-9f, -0x1p-9f};
            // Powers of two: positions and weights stay exact in 32 bits.
            frame.motion({x, y}).x += off[(x + 2 * y) % 5];
            frame.motion({x, y}).y += off[(x + 3 * y) % 7 % 5];
        }
    return frame;
}

inline reference::TemporalResult expectCounted(const RandomFrame& frame,
                                               const gpu::TemporalParams& params,
                                               bool historyValid = true) {
    const Image<glm::vec4> ranges = luminanceRanges(frame);
    return reference::temporal({.raw = frame.raw,
                                .visibility = frame.visibility,
                                .previousVisibility = frame.previousVisibility,
                                .guides = frame.guides,
                                .previousGuides = frame.previousGuides,
                                .slope = frame.slope,
                                .motion = frame.motion,
                                .previousColor = frame.previousColor,
                                .previousMoments = frame.previousMoments,
                                .lambda = frame.lambda,
                                .historyValid = historyValid,
                                .luminanceRange = &ranges,
                                .change = &frame.change,
                                .changed = frame.changed,
                                .samples = &frame.samples},
                               params);
}

/// Counted histories by every fetch, one with a clamp, and lambda fetched by light where it blends
/// and cuts. Each takes a program, whose compilation costs more than all that it is run for.
inline std::vector<gpu::TemporalParams> countedPlans() {
    std::vector<gpu::TemporalParams> plans;
    const auto add = [&](auto change) {
        plans.push_back(kCounts);
        change(plans.back());
    };
    add([](gpu::TemporalParams& p) {
        p.lambdaFetch = gpu::kLambdaNearest;
        p.clampRadius = 1;
        p.alphaMoments = 0.0f;
        p.maxHistory = 4.0f;
    });
    for (const int fetch : {gpu::kLambdaBilinear, gpu::kLambdaMax, gpu::kLambdaLight})
        add([&](gpu::TemporalParams& p) {
            p.lambdaFetch = fetch;
            p.countReusedOnce = fetch % 2;
        });
    add([](gpu::TemporalParams& p) {
        p.lambdaUse = gpu::kLambdaBlends;
        p.historyLaw = gpu::kHistoryPower;
        p.alpha = 0.05f;
    });
    add([](gpu::TemporalParams& p) {
        p.lambdaUse = gpu::kLambdaCuts;
        p.alpha = 0.05f;
    });
    return plans;
}

} // namespace afterglow::test
