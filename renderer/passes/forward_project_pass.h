#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"
#include "renderer/resources/scene_gpu.h"

namespace afterglow {

/// Carries one surface sample of each stratum of the last frame, with its seed, into this frame and
/// merges it into the visibility buffer. Schied et al. 2018, section 4.1.
/// See shaders/denoise/forward_claim.comp and forward_merge.comp. Reads the frame block.
class ForwardProjectPass {
public:
    struct Inputs {
        const GpuTexture& previousVisibility;
        const GpuTexture& previousSeeds;
        const GpuTexture& previousRaw;
    };
    struct Outputs {
        GpuTexture& visibility; ///< of this frame; patched
        GpuTexture& seeds;      ///< of this frame; patched
        GpuTexture& owners;     ///< scratch
        GpuTexture& samples;
        GpuTexture& counters;
    };

    explicit ForwardProjectPass(ShaderLibrary& shaders);
    void run(FrameContext& frame, const SceneGpu& scene, const Inputs& in, const Outputs& out);

private:
    ComputeProgram& claim_;
    ComputeProgram& merge_;
};

} // namespace afterglow
