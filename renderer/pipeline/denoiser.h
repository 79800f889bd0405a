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

    /// Carries last frame's samples into this one, before anything is shaded: into the visibility
    /// buffer and the seeds, or to RenderTargets::extra, which must not be empty then.
    void carrySamples(FrameContext& frame, const SceneGpu& scene, RenderTargets& targets,
                      SamplePlacement placement);

    /// From the raw signal to the filtered one, with the histories of `filter`, which is one of
    /// those of `targets`; returns the texture that holds it.
    const GpuTexture& run(FrameContext& frame, const DenoisePlan& plan,
                          const RenderTargets& targets, FilterTargets& filter,
                          const DenoiserSettings& settings, SamplePlacement placement);

private:
    struct Run {
        FrameContext& frame;
        const DenoisePlan& plan;
        const RenderTargets& shared;
        FilterTargets& own;
        const DenoiserSettings& settings;
    };
    void reconstructGradient(const Run& run, SamplePlacement placement);
    void accumulate(const Run& run);
    const GpuTexture& filter(const Run& run);

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
