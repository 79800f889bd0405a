#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"
#include "shared/post_params.h"

namespace afterglow {

/// A running sum of raw signals in 32-bit float, and its mean: the converged reference.
/// See shaders/lighting/accumulate.comp and mean.comp. Reads the frame block.
class ReferencePass {
public:
    explicit ReferencePass(ShaderLibrary& shaders);
    void add(FrameContext& frame, const GpuTexture& raw, GpuTexture& sum);
    void mean(FrameContext& frame, const GpuTexture& sum, int samples, GpuTexture& mean);

private:
    ComputeProgram& accumulate_;
    ComputeProgram& mean_;
};

} // namespace afterglow
