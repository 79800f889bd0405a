// SPDX-License-Identifier: MIT
#include "renderer/filters/svgf_filter.h"

namespace afterglow {

using namespace svgf;

svgf::Image svgf::blendOf(const SvgfPlan& plan) {
    return plan.feedbackIteration == 0 ? kColor : kAccumulated;
}

TemporalPass::Inputs svgf::temporalInputs(const FilterInput& in, FilterImages own) {
    return {in.newest,
            in.surfaces.visibility,
            in.previousVisibility,
            in.surfaces.guides,
            in.previousGuides,
            in.surfaces.slope,
            in.motion,
            own.previous(kColor),
            own.previous(kMoments),
            own[kLambda],
            own[kLuminanceRange],
            own[kChange],
            own[kChanged],
            in.samples};
}

gpu::TemporalParams svgf::temporalParams(const FilterInput& in, const SvgfPlan& plan) {
    gpu::TemporalParams params = plan.temporal;
    if (in.samplesBeside)
        params.countReusedOnce = 0; // no sample of the picture is a reused one
    return params;
}

GradientPass::Inputs svgf::gradientInputs(const FilterInput& in) {
    return {in.signal.raw.current(), in.signal.raw.previous(), in.samples, in.surfaces.guides,
            in.samplesBeside ? &in.signal.sampleRaw : nullptr};
}

SvgfFilter::SvgfFilter(ShaderLibrary& shaders)
    : gradient_(shaders), gradientSpline_(shaders, Kernel::B3Spline5x5),
      gradientBox_(shaders, Kernel::Box3x3), lambda_(shaders), lightPairs_(shaders),
      lightPairsAtrous_(shaders), change_(shaders), luminanceRange_(shaders), temporal_(shaders),
      variance_(shaders), atrousSpline_(shaders, Kernel::B3Spline5x5),
      atrousBox_(shaders, Kernel::Box3x3) {
    // What is needed first in most runs: a program is otherwise compiled in the frame that meets
    // it.
    const SvgfPlan plan = makePlan({});
    temporal_.prepare(plan.temporal);
    atrousOf(plan).prepare(plan.edges);
    gradientAtrousOf(plan).prepare(plan.gradientEdges);
}

AtrousPass& SvgfFilter::atrousOf(const SvgfPlan& plan) {
    return plan.kernel == Kernel::B3Spline5x5 ? atrousSpline_ : atrousBox_;
}

GradientAtrousPass& SvgfFilter::gradientAtrousOf(const SvgfPlan& plan) {
    return plan.gradientKernel == Kernel::B3Spline5x5 ? gradientSpline_ : gradientBox_;
}

const GpuTexture& SvgfFilter::run(FrameContext& frame, const FilterInput& in,
                                  const FilterSettings& settings, FilterImages own) {
    return run(frame, in, makePlan(settings), own);
}

const GpuTexture& SvgfFilter::run(FrameContext& frame, const FilterInput& in, const SvgfPlan& plan,
                                  FilterImages own) {
    const Run run{frame, in, plan, own};
    if (plan.useChange)
        reconstructChange(run);
    else if (plan.useLambda)
        reconstructGradient(run);
    if (plan.usePercentiles)
        luminanceRange_.run(frame, {in.newest, in.surfaces.guides}, {own[kLuminanceRange]},
                            plan.percentiles);
    if (!plan.accumulate) {
        own[kMoments].clear(); // history lengths of 0: whoever comes next starts anew
        return in.newest;
    }
    accumulate(run);
    return filter(run);
}

void SvgfFilter::reconstructGradient(const Run& run) {
    const auto& [frame, in, plan, own] = run;
    gradient_.run(frame, gradientInputs(in), {own[kGradientSamples]}, plan.gradient);
    GradientAtrousPass& atrous = gradientAtrousOf(plan);
    gpu::EdgeStopping edges = plan.gradientEdges;
    const GpuTexture* newest = &own[kGradientSamples];
    for (int k = 0; k < plan.gradientIterations; ++k) {
        edges.step = plan.gradientStep(k);
        // The last is kGradient0.
        GpuTexture& out = own[(plan.gradientIterations - 1 - k) % 2 == 0 ? kGradient0 : kGradient1];
        atrous.run(frame, {*newest, in.strataGuides, in.strataSlope}, {out}, edges);
        newest = &out;
    }
    lambda_.run(frame, {*newest}, {own[kLambda]}, plan.gradient);
}

void SvgfFilter::reconstructChange(const Run& run) {
    const auto& [frame, in, plan, own] = run;
    const auto pairsAt = [&own = own](svgf::Image first) -> LightPairs {
        return {own[first], own[first + 1], own[first + 2]};
    };
    svgf::Image newest = kBefore;
    lightPairs_.run(frame, gradientInputs(in), {pairsAt(newest), own[kChanged]});
    gpu::EdgeStopping edges = plan.gradientEdges;
    for (int k = 0; k < plan.gradientIterations; ++k) {
        edges.step = plan.gradientStep(k);
        // The last is kBefore0.
        const svgf::Image out = (plan.gradientIterations - 1 - k) % 2 == 0 ? kBefore0 : kBefore1;
        lightPairsAtrous_.run(frame, {pairsAt(newest), in.strataGuides, in.strataSlope},
                              {pairsAt(out)}, plan.gradientKernel, edges);
        newest = out;
    }
    change_.run(frame, {pairsAt(newest)}, {own[kLambda], own[kChange]}, plan.change);
}

void SvgfFilter::accumulate(const Run& run) {
    const auto& [frame, in, plan, own] = run;
    temporal_.run(frame, temporalInputs(in, own),
                  {own[blendOf(plan)], own[kMoments], own[kControl]}, temporalParams(in, plan));
}

const GpuTexture& SvgfFilter::filter(const Run& run) {
    const auto& [frame, in, plan, own] = run;
    const GpuTexture& accumulated = own[blendOf(plan)];
    if (plan.atrousIterations == 0)
        return accumulated;
    variance_.run(frame, {accumulated, own[kMoments], in.surfaces.guides, in.surfaces.slope},
                  {own[kFiltered0]}, plan.variance);
    AtrousPass& atrous = atrousOf(plan);
    gpu::EdgeStopping edges = plan.edges;
    const GpuTexture* newest = &own[kFiltered0];
    bool first = false; // which of the two that take turns is next
    for (int k = 1; k <= plan.atrousIterations; ++k) {
        edges.step = 1 << (k - 1);
        const bool isHistory = k == plan.feedbackIteration;
        GpuTexture& out = own[isHistory ? kColor : first ? kFiltered0 : kFiltered1];
        atrous.run(frame, {*newest, in.surfaces.guides, in.surfaces.slope}, {out}, edges);
        if (!isHistory)
            first = !first;
        newest = &out;
    }
    return *newest;
}

} // namespace afterglow
