// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"
#include "shared/denoise_params.h"

namespace afterglow {

/// Variance of the luminance: over time, or in space where the history is short.
/// Schied et al. 2017, section 4.2. See shaders/denoise/variance.comp and docs/pipeline.md.
class VariancePass {
public:
    struct Inputs {
        const GpuTexture& accumulated;
        const GpuTexture& moments;
        const GpuTexture& guides;
        const GpuTexture& slope;
    };
    struct Outputs {
        GpuTexture& filtered; ///< rgb: accumulated; a: variance
    };

    explicit VariancePass(ShaderLibrary& shaders);
    void run(FrameContext& frame, const Inputs& in, const Outputs& out,
             const gpu::VarianceParams& params);

private:
    ComputeProgram& program_;
};

} // namespace afterglow
