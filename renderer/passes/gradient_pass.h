// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/findings.h"
#include "renderer/passes/frame_context.h"
#include "shared/denoise_params.h"
#include "shared/instrument_params.h"

namespace afterglow {

/// Normal, depth and slope of each stratum: the guides of all filters on their grid. See
/// shaders/denoise/strata.comp and docs/pipeline.md.
class StrataPass {
public:
    struct Inputs {
        const GpuTexture& guides;
        const GpuTexture& slope;
    };
    struct Outputs {
        GpuTexture& strataGuides; ///< as guides, per stratum
        GpuTexture& strataSlope;  ///< as slope, per stratum
    };

    explicit StrataPass(ShaderLibrary& shaders);
    void run(FrameContext& frame, const Inputs& in, const Outputs& out);

private:
    ComputeProgram& program_;
};

/// The temporal gradient of a signal at each stratum's sample, and mean and variance of the signal
/// in the stratum. Schied et al. 2018, section 4.2. See shaders/denoise/gradient.comp and
/// docs/pipeline.md.
class GradientPass {
public:
    struct Inputs {
        const GpuTexture& raw;
        const GpuTexture& previousRaw;
        const GpuTexture& samples;
        const GpuTexture& guides;
        const GpuTexture* sampleRaw = nullptr; ///< per stratum; empty: the samples are in `raw`

        std::vector<Binding> bindings() const;
        /// Returns what compiles the shader for them.
        Defines defines() const;
    };
    struct Outputs {
        GpuTexture& gradient; ///< delta, Delta, mean luminance, variance of luminance
    };

    using Findings = FindingsBuffer<gpu::GradientFindings>;

    explicit GradientPass(ShaderLibrary& shaders);
    void run(FrameContext& frame, const Inputs& in, const Outputs& out,
             const gpu::GradientParams& params);

    /// As TemporalPass::inspect(), of one stratum.
    Findings::Region inspect(FrameContext& frame, const Inputs& in,
                             const gpu::GradientParams& params, glm::ivec2 stratum,
                             PixelReadback& readback);

private:
    ShaderLibrary& shaders_;
    ComputeProgram& merged_;
    ComputeProgram& extra_;
    Findings findings_;
};

/// One a-trous iteration over delta and Delta on the grid of strata.
/// Schied et al. 2018, section 4.3. See shaders/denoise/gradient_atrous.comp and docs/pipeline.md.
class GradientAtrousPass {
public:
    struct Inputs {
        const GpuTexture& gradient;
        const GpuTexture& strataGuides;
        const GpuTexture& strataSlope;
    };
    struct Outputs {
        GpuTexture& filtered; ///< as Inputs::gradient; never the same texture
    };

    GradientAtrousPass(ShaderLibrary& shaders, Kernel kernel)
        : shaders_(shaders), kernel_(kernel) {}
    void prepare(const gpu::EdgeStopping& params); ///< as AtrousPass::prepare()
    void run(FrameContext& frame, const Inputs& in, const Outputs& out,
             const gpu::EdgeStopping& params);

private:
    ShaderLibrary& shaders_;
    Kernel kernel_;
};

/// Normalizes the filtered gradient. Schied et al. 2018, section 4.4.
class LambdaPass {
public:
    struct Inputs {
        const GpuTexture& gradient;
    };
    struct Outputs {
        GpuTexture& lambda; ///< [0, 1], per stratum
    };

    explicit LambdaPass(ShaderLibrary& shaders);
    void run(FrameContext& frame, const Inputs& in, const Outputs& out,
             const gpu::GradientParams& params);

private:
    ComputeProgram& program_;
};

} // namespace afterglow
