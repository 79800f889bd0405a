#pragma once

#include "renderer/passes/atrous_pass.h"
#include "renderer/passes/forward_project_pass.h"
#include "renderer/passes/gradient_pass.h"
#include "renderer/passes/luminance_range_pass.h"
#include "renderer/passes/temporal_pass.h"
#include "renderer/passes/variance_pass.h"
#include "renderer/pipeline/denoise_plan.h"
#include "renderer/resources/render_targets.h"

namespace afterglow {

/// Owns the denoising passes and runs a plan. It has no memory of its own: histories are in the
/// RenderTargets.
class Denoiser {
public:
    explicit Denoiser(ShaderLibrary& shaders);

    /// Merges last frame's samples into the visibility buffer and the seeds, before anything is
    /// shaded.
    void carrySamples(FrameContext& frame, const SceneGpu& scene, RenderTargets& targets);

    /// From the raw signal to the filtered one; returns the texture that holds it.
    const GpuTexture& run(FrameContext& frame, const DenoisePlan& plan, RenderTargets& targets,
                          const DenoiserSettings& settings);

private:
    void reconstructGradient(FrameContext& frame, const DenoisePlan& plan, RenderTargets& targets,
                             const DenoiserSettings& settings);
    void accumulate(FrameContext& frame, const DenoisePlan& plan, RenderTargets& targets,
                    const DenoiserSettings& settings);
    const GpuTexture& filter(FrameContext& frame, const DenoisePlan& plan, RenderTargets& targets,
                             const DenoiserSettings& settings);

    ForwardProjectPass forwardProject_;
    GradientPass gradient_;
    GradientAtrousPass gradientSpline_, gradientBox_;
    LambdaPass lambda_;
    LuminanceRangePass luminanceRange_;
    TemporalPass temporal_;
    VariancePass variance_;
    AtrousPass atrousSpline_, atrousBox_;
};

} // namespace afterglow
