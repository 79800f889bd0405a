#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"

namespace afterglow {

/// Signal times albedo plus emission: linear radiance. See shaders/post/composite.comp.
/// Reads the frame block.
class CompositePass {
public:
    struct Inputs {
        const GpuTexture& signal;
        const GpuTexture& albedo;
        const GpuTexture& emission;
        const GpuTexture& guides;
    };
    struct Outputs {
        GpuTexture& composed;
    };

    explicit CompositePass(ShaderLibrary& shaders);
    void run(FrameContext& frame, const Inputs& in, const Outputs& out);

private:
    ComputeProgram& program_;
};

} // namespace afterglow
