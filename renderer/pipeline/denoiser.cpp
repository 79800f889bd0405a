#include "renderer/pipeline/denoiser.h"

namespace afterglow {

Denoiser::Denoiser(ShaderLibrary& shaders)
    : forwardProject_(shaders), gradient_(shaders), gradientSpline_(shaders, Kernel::B3Spline5x5),
      gradientBox_(shaders, Kernel::Box3x3), lambda_(shaders), luminanceRange_(shaders),
      temporal_(shaders), variance_(shaders), atrousSpline_(shaders, Kernel::B3Spline5x5),
      atrousBox_(shaders, Kernel::Box3x3) {}

void Denoiser::carrySamples(FrameContext& frame, const SceneGpu& scene, RenderTargets& t) {
    forwardProject_.run(
        frame, scene, {t.visibility.previous(), t.seeds.previous(), t.raw.previous()},
        {t.visibility.current(), t.seeds.current(), t.owners, t.samples, t.counters});
}

const GpuTexture& Denoiser::run(FrameContext& frame, const DenoisePlan& plan, RenderTargets& t,
                                const DenoiserSettings& settings) {
    if (plan.useLambda)
        reconstructGradient(frame, plan, t, settings);
    if (plan.usePercentiles)
        luminanceRange_.run(frame, {t.raw.current(), t.guides.current()}, {t.luminanceRange},
                            settings.percentiles);
    if (!plan.accumulate) {
        t.moments.current().clear(); // history lengths of 0: whoever comes next starts anew
        return t.raw.current();
    }
    accumulate(frame, plan, t, settings);
    return filter(frame, plan, t, settings);
}

void Denoiser::reconstructGradient(FrameContext& frame, const DenoisePlan& plan, RenderTargets& t,
                                   const DenoiserSettings& settings) {
    gpu::GradientParams params = settings.gradient;
    params.magnitude = plan.gradientAbsolute ? gpu::kGradientAbsolute : gpu::kGradientSigned;
    gradient_.run(frame, {t.raw.current(), t.samples, t.guides.current(), t.slope},
                  {t.gradientSamples, t.strataGuides, t.strataSlope}, params);
    GradientAtrousPass& atrous =
        plan.gradientKernel == Kernel::B3Spline5x5 ? gradientSpline_ : gradientBox_;
    gpu::EdgeStopping edges = settings.gradientEdges;
    if (!plan.gradientLuminanceStop)
        edges.sigmaLuminance = 0.0f;
    const GpuTexture* newest = &t.gradientSamples;
    for (int k = 0; k < plan.gradientIterations; ++k) {
        edges.step = plan.gradientStridesLinear ? k + 1 : 1 << k;
        GpuTexture& out =
            t.gradient[(plan.gradientIterations - 1 - k) % 2]; // the last is gradient[0]
        atrous.run(frame, {*newest, t.strataGuides, t.strataSlope}, {out}, edges);
        newest = &out;
    }
    lambda_.run(frame, {*newest}, {t.lambda}, params);
}

void Denoiser::accumulate(FrameContext& frame, const DenoisePlan& plan, RenderTargets& t,
                          const DenoiserSettings& settings) {
    gpu::TemporalParams params = settings.temporal;
    params.lambdaSource = plan.useLambda        ? gpu::kLambdaFromGradient
                          : plan.usePercentiles ? gpu::kLambdaFromRange
                                                : gpu::kLambdaFromNothing;
    params.historyLaw = plan.historyLaw;
    params.lambdaUse = plan.cutHistory ? gpu::kLambdaCuts : gpu::kLambdaBlends;
    params.clampRadius = plan.clampHistory ? settings.temporal.clampRadius : -1;
    // What is fed back unfiltered is the history as it leaves this pass.
    GpuTexture& accumulated = plan.feedbackIteration == 0 ? t.color.current() : t.accumulated;
    temporal_.run(frame,
                  {t.raw.current(), t.visibility.current(), t.visibility.previous(),
                   t.guides.current(), t.guides.previous(), t.slope, t.motion, t.color.previous(),
                   t.moments.previous(), t.lambda, t.luminanceRange},
                  {accumulated, t.moments.current(), t.control}, params);
}

const GpuTexture& Denoiser::filter(FrameContext& frame, const DenoisePlan& plan, RenderTargets& t,
                                   const DenoiserSettings& settings) {
    const GpuTexture& accumulated = plan.feedbackIteration == 0 ? t.color.current() : t.accumulated;
    if (plan.atrousIterations == 0)
        return accumulated;
    variance_.run(
        frame, {accumulated, t.moments.current(), t.guides.current(), t.slope}, {t.filtered[0]},
        {settings.edges.sigmaNormal, settings.edges.sigmaDepth, settings.minHistory, 0.0f});
    AtrousPass& atrous =
        Kernel(settings.kernel) == Kernel::B3Spline5x5 ? atrousSpline_ : atrousBox_;
    gpu::EdgeStopping edges = settings.edges;
    const GpuTexture* newest = &t.filtered[0];
    int next = 1; // of the two that take turns
    for (int k = 1; k <= plan.atrousIterations; ++k) {
        edges.step = 1 << (k - 1);
        GpuTexture& out = k == plan.feedbackIteration ? t.color.current() : t.filtered[next];
        atrous.run(frame, {*newest, t.guides.current(), t.slope}, {out}, edges);
        if (&out != &t.color.current())
            next = 1 - next;
        newest = &out;
    }
    return *newest;
}

} // namespace afterglow
