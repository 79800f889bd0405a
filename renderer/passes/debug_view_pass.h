// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"
#include "shared/debug_view_params.h"

namespace afterglow {

/// Any image of a frame as colors: radiance, numbers, directions, numbers of things.
/// Not-a-number and infinity are magenta. See shaders/post/debug_view.comp.
class DebugViewPass {
public:
    explicit DebugViewPass(ShaderLibrary& shaders);

    /// `source`: R32F, RG32F, RGBA32F, R32UI, RG32UI or RGBA32UI, else std::logic_error.
    /// `display`: RGBA8, sRGB-encoded, of any size; it shows the upper left of what it cannot hold.
    void run(FrameContext& frame, const GpuTexture& source, GpuTexture& display,
             const gpu::DebugViewParams& params);

private:
    ShaderLibrary& shaders_;
};

} // namespace afterglow
