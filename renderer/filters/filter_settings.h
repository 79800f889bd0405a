// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/passes/frame_context.h"
#include "shared/denoise_params.h"

namespace afterglow {

/// By its place in the table of filters, filter_table.h.
enum class Filter { None, Fixed, Svgf, Asvgf, Clamp, Percentile, Confidence, Counted };

/// Of SVGF and its relatives. Ranges, units, meaning and source of every member: fields() in
/// renderer/pipeline/settings.h.
struct DenoiserSettings {
    gpu::TemporalParams temporal{.alpha = 0.2f,
                                 .alphaMoments = 0.2f,
                                 .maxHistory = 128.0f,
                                 .depthTolerance = 2.0f,
                                 .normalTolerance = 0.9f,
                                 .lambdaFetch = gpu::kLambdaMax,
                                 .historyLaw = gpu::kHistoryPower,
                                 .lambdaSource = gpu::kLambdaFromNothing, // set by the plan
                                 .lambdaUse = gpu::kLambdaBlends,
                                 .percentileSlope = 4.0f,
                                 .clampSigmas = 1.0f,
                                 .clampRadius = 2,
                                 .reactivity = 400.0f,
                                 .historyDuringChange = 8.0f,
                                 .historyBetweenPixels = 32.0f,
                                 .countReusedOnce = 1};
    gpu::PercentileParams percentiles{
        .lowPercentile = 0.1f, .highPercentile = 0.9f, .unused0 = 0.0f, .unused1 = 0.0f};
    gpu::GradientParams gradient{.deltaFloor = 1e-4f,
                                 .forceLambda = -1.0f,
                                 .magnitude = gpu::kGradientSigned,
                                 .unused0 = 0.0f};
    gpu::EdgeStopping edges{
        .sigmaLuminance = 4.0f, .sigmaNormal = 128.0f, .sigmaDepth = 1.0f, .step = 1};
    gpu::EdgeStopping gradientEdges{
        .sigmaLuminance = 4.0f, .sigmaNormal = 128.0f, .sigmaDepth = 1.0f, .step = 1};
    int gradientOver = gpu::kChangeOfLuminance;
    int scaleHistory = 1;
    float scaleDoubt = 10.0f;
    float minHistory = 4.0f;
    float varianceExponent = 0.0f;
    float shortHistoryBoost = 0.0f;
    int atrousIterations = 5;
    int feedbackIteration = 0; ///< whose result becomes the history; 0: the unfiltered blend
    int gradientIterations = 5;
    int kernel = int(Kernel::B3Spline5x5);
    int gradientKernel = int(Kernel::Box3x3);
    int gradientStrides = gpu::kStridesDouble;
    int gradientLuminanceStop = 1;
    int alwaysCarrySamples = 0; ///< gradient samples also where the filter does not use them
};

/// One filter with all of its parameters.
struct FilterSettings {
    Filter filter = Filter::Asvgf;
    DenoiserSettings denoiser;
};

/// Returns the parameters with which a filter begins.
DenoiserSettings defaultsOf(Filter filter);

} // namespace afterglow
