// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"
#include "shared/post_params.h"

namespace afterglow {

/// Averages frames that look through different points of each pixel. See shaders/post/taa.comp.
/// Reads the frame block.
class TaaPass {
public:
    struct Inputs {
        const GpuTexture& color; ///< linear
        const GpuTexture& guides;
        const GpuTexture& motion;
        const GpuTexture& history;            ///< what the frame before has resolved
        const GpuTexture* exposure = nullptr; ///< that the picture asks for, ExposurePass
    };
    struct Outputs {
        GpuTexture& resolved; ///< RGBA32F: linear; a: frames in it
    };

    explicit TaaPass(ShaderLibrary& shaders) : shaders_(shaders) {}
    void run(FrameContext& frame, const Inputs& in, const Outputs& out,
             const gpu::TaaParams& params);

private:
    ShaderLibrary& shaders_; ///< compiled when the pass first runs
};

} // namespace afterglow
