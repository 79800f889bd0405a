#include "renderer/pipeline/denoiser.h"

namespace afterglow {

Denoiser::Denoiser(ShaderLibrary& shaders)
    : forwardProject_(shaders), gradient_(shaders), gradientSpline_(shaders, Kernel::B3Spline5x5),
      gradientBox_(shaders, Kernel::Box3x3), lambda_(shaders), luminanceRange_(shaders),
      temporal_(shaders), variance_(shaders), atrousSpline_(shaders, Kernel::B3Spline5x5),
      atrousBox_(shaders, Kernel::Box3x3) {}

void Denoiser::carrySamples(FrameContext& frame, const SceneGpu& scene, RenderTargets& t,
                            SamplePlacement placement) {
    const bool extra = placement == SamplePlacement::Extra;
    forwardProject_.run(
        frame, scene,
        {t.visibility.previous(), t.seeds.previous(), t.raw.previous(), t.visibility.current()},
        {extra ? t.extra.visibility : t.visibility.current(),
         extra ? t.extra.seeds : t.seeds.current(), t.owners, t.claims, t.samples, t.counters});
}

const GpuTexture& Denoiser::run(FrameContext& frame, const DenoisePlan& plan,
                                const RenderTargets& shared, FilterTargets& own,
                                const DenoiserSettings& settings, SamplePlacement placement) {
    const Run run{frame, plan, shared, own, settings};
    if (plan.useLambda)
        reconstructGradient(run, placement);
    if (plan.usePercentiles)
        luminanceRange_.run(frame, {shared.raw.current(), shared.guides.current()},
                            {own.luminanceRange}, settings.percentiles);
    if (!plan.accumulate) {
        own.moments.current().clear(); // history lengths of 0: whoever comes next starts anew
        return shared.raw.current();
    }
    accumulate(run);
    return filter(run);
}

void Denoiser::reconstructGradient(const Run& run, SamplePlacement placement) {
    const auto& [frame, plan, shared, own, settings] = run;
    gpu::GradientParams params = settings.gradient;
    params.magnitude = plan.gradientAbsolute ? gpu::kGradientAbsolute : gpu::kGradientSigned;
    gradient_.run(frame,
                  {shared.raw.current(), shared.samples, shared.guides.current(), shared.slope,
                   placement == SamplePlacement::Extra ? &shared.extra.raw : nullptr},
                  {own.gradientSamples, own.strataGuides, own.strataSlope}, params);
    GradientAtrousPass& atrous =
        plan.gradientKernel == Kernel::B3Spline5x5 ? gradientSpline_ : gradientBox_;
    gpu::EdgeStopping edges = settings.gradientEdges;
    if (!plan.gradientLuminanceStop)
        edges.sigmaLuminance = 0.0f;
    const GpuTexture* newest = &own.gradientSamples;
    for (int k = 0; k < plan.gradientIterations; ++k) {
        edges.step = plan.gradientStridesLinear ? k + 1 : 1 << k;
        GpuTexture& out =
            own.gradient[(plan.gradientIterations - 1 - k) % 2]; // the last is gradient[0]
        atrous.run(frame, {*newest, own.strataGuides, own.strataSlope}, {out}, edges);
        newest = &out;
    }
    lambda_.run(frame, {*newest}, {own.lambda}, params);
}

void Denoiser::accumulate(const Run& run) {
    const auto& [frame, plan, shared, own, settings] = run;
    gpu::TemporalParams params = settings.temporal;
    params.lambdaSource = plan.useLambda        ? gpu::kLambdaFromGradient
                          : plan.usePercentiles ? gpu::kLambdaFromRange
                                                : gpu::kLambdaFromNothing;
    params.historyLaw = plan.historyLaw;
    params.lambdaUse = plan.cutHistory ? gpu::kLambdaCuts : gpu::kLambdaBlends;
    params.clampRadius = plan.clampHistory ? settings.temporal.clampRadius : -1;
    // What is fed back unfiltered is the history as it leaves this pass.
    GpuTexture& accumulated = plan.feedbackIteration == 0 ? own.color.current() : own.accumulated;
    temporal_.run(frame,
                  {shared.raw.current(), shared.visibility.current(), shared.visibility.previous(),
                   shared.guides.current(), shared.guides.previous(), shared.slope, shared.motion,
                   own.color.previous(), own.moments.previous(), own.lambda, own.luminanceRange},
                  {accumulated, own.moments.current(), own.control}, params);
}

const GpuTexture& Denoiser::filter(const Run& run) {
    const auto& [frame, plan, shared, own, settings] = run;
    const GpuTexture& accumulated =
        plan.feedbackIteration == 0 ? own.color.current() : own.accumulated;
    if (plan.atrousIterations == 0)
        return accumulated;
    variance_.run(
        frame, {accumulated, own.moments.current(), shared.guides.current(), shared.slope},
        {own.filtered[0]},
        {settings.edges.sigmaNormal, settings.edges.sigmaDepth, settings.minHistory, 0.0f});
    AtrousPass& atrous =
        Kernel(settings.kernel) == Kernel::B3Spline5x5 ? atrousSpline_ : atrousBox_;
    gpu::EdgeStopping edges = settings.edges;
    const GpuTexture* newest = &own.filtered[0];
    int next = 1; // of the two that take turns
    for (int k = 1; k <= plan.atrousIterations; ++k) {
        edges.step = 1 << (k - 1);
        GpuTexture& out = k == plan.feedbackIteration ? own.color.current() : own.filtered[next];
        atrous.run(frame, {*newest, shared.guides.current(), shared.slope}, {out}, edges);
        if (&out != &own.color.current())
            next = 1 - next;
        newest = &out;
    }
    return *newest;
}

} // namespace afterglow
