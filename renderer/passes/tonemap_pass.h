// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"
#include "shared/post_params.h"

namespace afterglow {

/// Linear radiance to the display. See shaders/post/tonemap.comp. Reads the frame block.
class TonemapPass {
public:
    struct Inputs {
        const GpuTexture& composed;
        const GpuTexture* exposure = nullptr; ///< that the picture asks for, ExposurePass
    };

    explicit TonemapPass(ShaderLibrary& shaders);
    /// `toneMapper`: kTone...; each has a program of its own, compiled when it is first met.
    void run(FrameContext& frame, const Inputs& in, GpuTexture& display, int toneMapper,
             const gpu::TonemapParams& params);

private:
    ShaderLibrary& shaders_;
};

} // namespace afterglow
