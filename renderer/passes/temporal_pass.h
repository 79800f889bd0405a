// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/findings.h"
#include "renderer/passes/frame_context.h"
#include "shared/denoise_params.h"
#include "shared/instrument_params.h"

namespace afterglow {

/// Back-projects the history and blends the new sample into it with an alpha per pixel.
/// Schied et al. 2017, section 4.1; Schied et al. 2018, section 4.4; and what three competing
/// filters do with a history instead; and the counted history.
/// Reads FrameUniforms::historyValid. See shaders/denoise/temporal.comp and docs/pipeline.md.
class TemporalPass {
public:
    struct Inputs {
        const GpuTexture& raw;
        const GpuTexture& visibility;
        const GpuTexture& previousVisibility;
        const GpuTexture& guides;
        const GpuTexture& previousGuides;
        const GpuTexture& slope;
        const GpuTexture& motion;
        const GpuTexture& previousColor;
        const GpuTexture& previousMoments;
        const GpuTexture& lambda;         ///< per stratum; used with kLambdaFromGradient
        const GpuTexture& luminanceRange; ///< per tile; used with kLambdaFromRange
        const GpuTexture& change;         ///< per stratum; used with kLambdaCounts and kLambdaLight
        const GpuTexture& changed; ///< strata whose light has changed; used with kLambdaCounts
        const GpuTexture& samples; ///< per stratum; used with kLambdaCounts
    };
    struct Outputs {
        GpuTexture& accumulated;
        GpuTexture& moments;
        GpuTexture& control;
    };

    using Findings = FindingsBuffer<gpu::TemporalFindings>;

    explicit TemporalPass(ShaderLibrary& shaders);
    /// Compiles the program for a plan, which run() does otherwise when it first meets the plan.
    void prepare(const gpu::TemporalParams& params);
    void run(FrameContext& frame, const Inputs& in, const Outputs& out,
             const gpu::TemporalParams& params);

    /// Runs the same shader for one pixel, compiled to write all that it computes there, and adds
    /// that to the readback. After run(), with the same frame and inputs, the results are the same.
    Findings::Region inspect(FrameContext& frame, const Inputs& in,
                             const gpu::TemporalParams& params, glm::ivec2 pixel,
                             PixelReadback& readback);

private:
    ShaderLibrary& shaders_;
    Findings findings_;
};

} // namespace afterglow
