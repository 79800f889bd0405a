// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"
#include "renderer/resources/scene_gpu.h"
#include "renderer/resources/surfaces.h"

namespace afterglow {

/// One noisy sample per pixel of the demodulated signal. See shaders/lighting/lighting.comp.
/// Reads the frame block.
class LightingPass {
public:
    struct Inputs {
        const Surfaces& surfaces;
        const GpuTexture& seeds;
    };
    struct Outputs {
        GpuTexture& raw;
        GpuTexture& counters;
    };
    struct Rays {
        bool shadows = true, ambientOcclusion = true; ///< at least one
        bool operator==(const Rays&) const = default;
    };

    explicit LightingPass(ShaderLibrary& shaders) : shaders_(shaders) {}
    void run(FrameContext& frame, const SceneGpu& scene, const Inputs& in, const Outputs& out,
             Rays rays);

private:
    ShaderLibrary& shaders_;
};

} // namespace afterglow
