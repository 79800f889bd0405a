// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"

namespace afterglow {

enum class Difference {
    Signed,  ///< a - b
    Absolute ///< |a - b|
};

/// What one image has more than another, in every channel. DebugViewPass shows it.
/// See shaders/post/difference.comp.
class DifferencePass {
public:
    explicit DifferencePass(ShaderLibrary& shaders);

    /// `a`, `b`: both R32F, RG32F or RGBA32F. `difference`: RGBA32F; channels that the two do not
    /// have are 0. All of one size. Anything else is std::logic_error.
    void run(FrameContext& frame, const GpuTexture& a, const GpuTexture& b, GpuTexture& difference,
             Difference kind = Difference::Signed);

private:
    ShaderLibrary& shaders_;
};

} // namespace afterglow
