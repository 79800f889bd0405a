// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"
#include "shared/post_params.h"

namespace afterglow {

/// The exposure that a picture asks for, and a step towards it. See shaders/post/log_luminance.comp
/// and exposure.comp. Reads the frame block.
class ExposurePass {
public:
    struct Inputs {
        const GpuTexture& composed;
        const GpuTexture& guides;
        const GpuTexture& previousExposure; ///< one texel; all 0: none
    };
    struct Outputs {
        GpuTexture& sums;     ///< RGBA32F, a texel a tile
        GpuTexture& exposure; ///< RGBA32F, one texel: stops, mean log2, foreground pixels, 1
    };

    explicit ExposurePass(ShaderLibrary& shaders) : shaders_(shaders) {}
    void run(FrameContext& frame, const Inputs& in, const Outputs& out,
             const gpu::ExposureParams& params);

private:
    ShaderLibrary& shaders_; ///< compiled when the pass first runs
};

} // namespace afterglow
