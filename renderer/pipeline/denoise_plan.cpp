#include "renderer/pipeline/denoise_plan.h"

#include <algorithm>

namespace afterglow {

namespace {

/// A-SVGF as it is set.
void addGradient(DenoisePlan& plan, const DenoiserSettings& settings) {
    plan.carrySamples = plan.useLambda = true;
    plan.cutHistory = settings.temporal.lambdaUse == gpu::kLambdaCuts;
    plan.gradientIterations = settings.gradientIterations;
    plan.gradientKernel = Kernel(settings.gradientKernel);
    plan.gradientStridesLinear = settings.gradientStrides == gpu::kStridesLinear;
    plan.gradientAbsolute = settings.gradient.magnitude == gpu::kGradientAbsolute;
    plan.gradientLuminanceStop = settings.gradientLuminanceStop != 0;
}

/// The same gradient samples, used as NRD advises in its README on history confidence.
void addConfidence(DenoisePlan& plan, const DenoiserSettings& settings) {
    addGradient(plan, settings);
    plan.cutHistory = true;
    plan.gradientKernel = Kernel::B3Spline5x5;
    plan.gradientStridesLinear = true;
    plan.gradientAbsolute = true;
    plan.gradientLuminanceStop = false;
    // Its cut is of a history as long as it counts for, not of all frames that were ever blended.
    plan.historyLaw = gpu::kHistoryEffective;
}

} // namespace

DenoisePlan makePlan(Filter filter, const DenoiserSettings& settings) {
    DenoisePlan plan;
    plan.accumulate = filter != Filter::None;
    if (plan.accumulate)
        plan.historyLaw = settings.temporal.historyLaw;
    plan.carrySamples = settings.alwaysCarrySamples != 0;
    if (filter != Filter::None && filter != Filter::Fixed) {
        plan.atrousIterations = settings.atrousIterations;
        plan.feedbackIteration = std::min(settings.feedbackIteration, settings.atrousIterations);
    }
    switch (filter) {
    case Filter::None:
    case Filter::Fixed:
    case Filter::Svgf: break;
    case Filter::Asvgf: addGradient(plan, settings); break;
    case Filter::Clamp: plan.clampHistory = true; break;
    case Filter::Percentile:
        plan.usePercentiles = true;
        plan.cutHistory = settings.temporal.lambdaUse == gpu::kLambdaCuts;
        break;
    case Filter::Confidence: addConfidence(plan, settings); break;
    }
    return plan;
}

bool carriesSamples(const Settings& settings) {
    return makePlan(settings.filter, settings.denoiser).carrySamples;
}

} // namespace afterglow
