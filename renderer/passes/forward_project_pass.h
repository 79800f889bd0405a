// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"
#include "renderer/resources/scene_gpu.h"

namespace afterglow {

/// Carries one surface sample of each stratum of the last frame, with its seed, into this frame and
/// merges it into the visibility buffer, or sets it beside the picture, one texel a stratum. Schied
/// et al. 2018, section 4.1. See shaders/denoise/forward_claim.comp and forward_merge.comp. Reads
/// the frame block.
class ForwardProjectPass {
public:
    struct Inputs {
        const GpuTexture& previousVisibility;
        const GpuTexture& previousSeeds;
        const GpuTexture& visibility; ///< of this frame, before anything is merged into it
    };
    struct Outputs {
        GpuTexture& visibility; ///< where the samples go: of this frame, or one texel a stratum
        GpuTexture& seeds;      ///< likewise
        GpuTexture& owners;     ///< scratch
        GpuTexture& claims;     ///< scratch
        GpuTexture& samples;    ///< which pixel of the last frame landed where; RGBA32UI
        GpuTexture& counters;
    };

    explicit ForwardProjectPass(ShaderLibrary& shaders);
    void run(FrameContext& frame, const SceneGpu& scene, const Inputs& in, const Outputs& out);

private:
    ComputeProgram& claim_;
    ComputeProgram& merge_;
    ComputeProgram& mergeExtra_;
};

} // namespace afterglow
