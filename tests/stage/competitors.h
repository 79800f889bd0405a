// SPDX-License-Identifier: MIT
#pragma once

#include "tests/reference/temporal.h"
#include "tests/stage/stage_runner.h"

namespace afterglow::test {

// Parts that the tests of the competing filters share.

inline const gpu::PercentileParams kPercentiles[] = {{0.1f, 0.9f, 0.0f, 0.0f},
                                                     {0.0f, 1.0f, 0.0f, 0.0f},
                                                     {0.5f, 0.5f, 0.0f, 0.0f},
                                                     {0.9f, 0.2f, 0.0f, 0.0f}};

/// Nothing but the blend.
inline const gpu::TemporalParams kPlain{.alpha = 0.1f,
                                        .alphaMoments = 0.2f,
                                        .maxHistory = 64.0f,
                                        .depthTolerance = 2.0f,
                                        .normalTolerance = 0.9f,
                                        .lambdaFetch = gpu::kLambdaBilinear,
                                        .historyLaw = gpu::kHistoryEffective,
                                        .lambdaSource = gpu::kLambdaFromNothing,
                                        .lambdaUse = gpu::kLambdaBlends,
                                        .percentileSlope = 1.0f,
                                        .clampSigmas = 1.0f,
                                        .clampRadius = -1,
                                        .reactivity = 20.0f,
                                        .historyDuringChange = 8.0f,
                                        .historyBetweenPixels = 16.0f,
                                        .countReusedOnce = 1};

inline gpu::TemporalParams clamped(int radius, float sigmas) {
    gpu::TemporalParams params = kPlain;
    params.clampRadius = radius;
    params.clampSigmas = sigmas;
    return params;
}

inline gpu::TemporalParams adaptive(int source, int use, int law = gpu::kHistoryEffective) {
    gpu::TemporalParams params = kPlain;
    params.lambdaSource = source;
    params.lambdaUse = use;
    params.historyLaw = law;
    return params;
}

inline reference::TemporalResult expect(const RandomFrame& frame,
                                        const gpu::TemporalParams& params) {
    const Image<glm::vec4> ranges = luminanceRanges(frame);
    return reference::temporal({frame.raw, frame.visibility, frame.previousVisibility, frame.guides,
                                frame.previousGuides, frame.slope, frame.motion,
                                frame.previousColor, frame.previousMoments, frame.lambda, true,
                                &ranges},
                               params);
}

} // namespace afterglow::test
