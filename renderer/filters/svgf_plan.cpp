// SPDX-License-Identifier: MIT
#include "renderer/filters/svgf_plan.h"

#include <algorithm>

namespace afterglow {

namespace {

/// A-SVGF as it is set.
void addGradient(SvgfPlan& plan) {
    plan.carrySamples = plan.useLambda = true;
    plan.temporal.lambdaSource = gpu::kLambdaFromGradient;
}

/// The same gradient samples, used as NRD advises in its README on history confidence.
void addConfidence(SvgfPlan& plan) {
    addGradient(plan);
    plan.temporal.lambdaUse = gpu::kLambdaCuts;
    plan.gradientKernel = Kernel::B3Spline5x5;
    plan.gradientStridesLinear = true;
    plan.gradient.magnitude = gpu::kGradientAbsolute;
    plan.gradientEdges.sigmaLuminance = 0.0f;
    // Its cut is of a history as long as it counts for, not of all frames that were ever blended.
    plan.temporal.historyLaw = gpu::kHistoryEffective;
}

/// The history as a mean of samples, from which changes take some away.
void addCount(SvgfPlan& plan) {
    addGradient(plan);
    plan.useChange = true;
    plan.temporal.lambdaUse = gpu::kLambdaCounts;
    plan.temporal.historyLaw = gpu::kHistoryFrames; // not read: the count is the history length
}

/// All that is set, for a filter that uses all of it.
SvgfPlan asSet(const DenoiserSettings& s) {
    SvgfPlan plan;
    plan.carrySamples = s.alwaysCarrySamples != 0;
    plan.temporal = s.temporal;
    plan.temporal.lambdaSource = gpu::kLambdaFromNothing;
    plan.percentiles = s.percentiles;
    plan.gradient = s.gradient;
    plan.gradientEdges = s.gradientEdges;
    if (s.gradientLuminanceStop == 0)
        plan.gradientEdges.sigmaLuminance = 0.0f;
    plan.gradientIterations = s.gradientIterations;
    plan.gradientKernel = Kernel(s.gradientKernel);
    plan.gradientStridesLinear = s.gradientStrides == gpu::kStridesLinear;
    plan.change = {.deltaFloor = s.gradient.deltaFloor,
                   .forceLambda = s.gradient.forceLambda,
                   .over = s.gradientOver,
                   .scaleHistory = s.scaleHistory,
                   .scaleDoubt = s.scaleDoubt,
                   .unused0 = 0.0f,
                   .unused1 = 0.0f,
                   .unused2 = 0.0f};
    plan.variance = {.sigmaNormal = s.edges.sigmaNormal,
                     .sigmaDepth = s.edges.sigmaDepth,
                     .minHistory = s.minHistory,
                     .varianceExponent = s.varianceExponent,
                     .shortHistoryBoost = s.shortHistoryBoost,
                     .unused0 = 0.0f,
                     .unused1 = 0.0f,
                     .unused2 = 0.0f};
    plan.edges = s.edges;
    plan.atrousIterations = s.atrousIterations;
    plan.kernel = Kernel(s.kernel);
    plan.feedbackIteration = std::min(s.feedbackIteration, s.atrousIterations);
    return plan;
}

} // namespace

DenoiserSettings defaultsOf(Filter filter) {
    DenoiserSettings settings;
    if (filter == Filter::Counted) {
        settings.temporal.lambdaFetch = gpu::kLambdaLight;
        settings.gradientOver = gpu::kChangeOfChannels;
        settings.varianceExponent = 1.25f;
        settings.atrousIterations = 3;
    }
    return settings;
}

SvgfPlan makePlan(const FilterSettings& settings) {
    const Filter filter = settings.filter;
    SvgfPlan plan = asSet(settings.denoiser);
    plan.accumulate = filter != Filter::None;
    if (filter == Filter::None || filter == Filter::Fixed)
        plan.atrousIterations = plan.feedbackIteration = 0;
    if (filter == Filter::Asvgf) {
        addGradient(plan);
        plan.useChange = settings.denoiser.gradientOver == gpu::kChangeOfChannels ||
                         plan.temporal.lambdaFetch == gpu::kLambdaLight;
    }
    if (filter == Filter::Counted)
        addCount(plan);
    if (filter == Filter::Confidence)
        addConfidence(plan);
    if (filter == Filter::Percentile) {
        plan.usePercentiles = true;
        plan.temporal.lambdaSource = gpu::kLambdaFromRange;
    }
    if (filter != Filter::Clamp)
        plan.temporal.clampRadius = -1;
    if (!plan.useLambda && !plan.usePercentiles)
        plan.temporal.lambdaUse = gpu::kLambdaBlends; // there is none that could cut
    if (!plan.useChange && plan.temporal.lambdaFetch == gpu::kLambdaLight)
        plan.temporal.lambdaFetch = gpu::kLambdaMax; // without a change there is no light of it
    if (!plan.countsSamples() && plan.temporal.historyLaw != gpu::kHistoryEffective)
        plan.variance.varianceExponent = 0.0f; // a count of frames is no count of samples
    return plan;
}

} // namespace afterglow
