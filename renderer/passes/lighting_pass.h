#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"
#include "renderer/resources/scene_gpu.h"

#include <array>

namespace afterglow {

/// One noisy sample per pixel of the demodulated signal. See shaders/lighting/lighting.comp.
/// Reads the frame block.
class LightingPass {
public:
    struct Inputs {
        const GpuTexture& visibility;
        const GpuTexture& surface;
        const GpuTexture& guides;
        const GpuTexture& seeds;
    };
    struct Outputs {
        GpuTexture& raw;
        GpuTexture& counters;
    };
    struct Rays {
        bool shadows = true, ambientOcclusion = true; ///< at least one
    };

    explicit LightingPass(ShaderLibrary& shaders) : shaders_(shaders) {}
    void run(FrameContext& frame, const SceneGpu& scene, const Inputs& in, const Outputs& out,
             Rays rays);

private:
    ShaderLibrary& shaders_;
};

} // namespace afterglow
