#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"
#include "renderer/resources/scene_gpu.h"

namespace afterglow {

/// The surface behind each visibility sample. See shaders/scene/surface.comp. Reads the frame
/// block.
class SurfacePass {
public:
    struct Inputs {
        const GpuTexture& visibility;
    };
    struct Outputs {
        GpuTexture& surface;
        GpuTexture& guides;
        GpuTexture& slope;
        GpuTexture& motion;
        GpuTexture& albedo;
        GpuTexture& emission;
    };

    explicit SurfacePass(ShaderLibrary& shaders);
    void run(FrameContext& frame, const SceneGpu& scene, const Inputs& in, const Outputs& out);

private:
    ComputeProgram& program_;
};

} // namespace afterglow
