// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"
#include "shared/post_params.h"

namespace afterglow {

/// Linear radiance to the display. See shaders/post/tonemap.comp. Reads the frame block.
class TonemapPass {
public:
    explicit TonemapPass(ShaderLibrary& shaders);
    void run(FrameContext& frame, const GpuTexture& composed, GpuTexture& display,
             const gpu::TonemapParams& params);

private:
    ComputeProgram& program_;
};

} // namespace afterglow
