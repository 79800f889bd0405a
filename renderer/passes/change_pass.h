// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/gradient_pass.h"
#include "shared/denoise_params.h"

namespace afterglow {

/// The light of gradient samples in two frames, by channel; one texel a stratum. See "Change of
/// light" in docs/pipeline.md.
struct LightPairs {
    GpuTexture& before;   ///< RGBA32F: rgb: light before; a: 1 where there is a sample
    GpuTexture& now;      ///< RGBA32F: rgb: light now; a: mean luminance of the stratum
    GpuTexture& products; ///< RGBA32F: before . before, before . now, now . now, variance
};

/// Compares the light of gradient samples with that of the frame before, channel by channel.
/// Forward projection as in Schied et al. 2018, section 4.1; the rest is our own.
/// See shaders/denoise/gradient.comp and docs/pipeline.md.
class LightPairsPass {
public:
    using Inputs = GradientPass::Inputs;
    struct Outputs {
        LightPairs pairs;
        GpuTexture& changed; ///< R32UI, one texel: strata whose light has changed
    };

    explicit LightPairsPass(ShaderLibrary& shaders) : shaders_(shaders) {}
    void run(FrameContext& frame, const Inputs& in, const Outputs& out);

private:
    ShaderLibrary& shaders_;
};

/// One a-trous iteration over light pairs on the grid of strata.
/// Weights as in Schied et al. 2018, section 4.3. See shaders/denoise/gradient_atrous.comp.
class LightPairsAtrousPass {
public:
    struct Inputs {
        LightPairs pairs;
        const GpuTexture& strataGuides;
        const GpuTexture& strataSlope;
    };
    struct Outputs {
        LightPairs filtered; ///< never the textures of Inputs::pairs
    };

    explicit LightPairsAtrousPass(ShaderLibrary& shaders) : shaders_(shaders) {}
    void run(FrameContext& frame, const Inputs& in, const Outputs& out, Kernel kernel,
             const gpu::EdgeStopping& params);

private:
    ShaderLibrary& shaders_;
};

/// Tells from reconstructed light pairs by how much light has changed, whether by one factor, and
/// how sure that is. See shaders/denoise/change.comp and docs/pipeline.md.
class ChangePass {
public:
    struct Inputs {
        LightPairs pairs;
    };
    struct Outputs {
        GpuTexture& lambda; ///< R32F, strata: [0, 1]
        GpuTexture& change; ///< RGBA32F, strata: squared relative bias that is left (E), relative
                            ///< variance of one sample (v), factor, weight
    };

    explicit ChangePass(ShaderLibrary& shaders) : shaders_(shaders) {}
    void run(FrameContext& frame, const Inputs& in, const Outputs& out,
             const gpu::ChangeParams& params);

private:
    ShaderLibrary& shaders_;
};

} // namespace afterglow
