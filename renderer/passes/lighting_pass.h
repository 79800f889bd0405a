// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"
#include "renderer/resources/ray_list.h"
#include "renderer/resources/scene_gpu.h"
#include "renderer/resources/surfaces.h"

namespace afterglow {

/// One noisy sample per pixel of the demodulated signal: for each kind of ray a list of those that
/// matter, and a walk over it. See shaders/lighting/. Reads the frame block.
class LightingPass {
public:
    struct Inputs {
        const Surfaces& surfaces;
        const GpuTexture& seeds;
    };
    struct Outputs {
        GpuTexture& raw;
        RayList& rays; ///< of at least this size; holds the last kind of rays afterwards
        GpuTexture& counters;
    };
    struct Rays {
        bool shadows = true, ambientOcclusion = true; ///< at least one
        bool operator==(const Rays&) const = default;
    };
    enum class Kind { Shadow, AmbientOcclusion };

    explicit LightingPass(ShaderLibrary& shaders) : shaders_(shaders) {}
    void run(FrameContext& frame, const SceneGpu& scene, const Inputs& in, const Outputs& out,
             Rays rays);

    /// The first half of a kind's work: lists the rays. The first kind of a signal makes `raw` new.
    void list(const FrameContext& frame, const SceneGpu& scene, const Inputs& in,
              const Outputs& out, Kind kind, bool isFirst);
    /// The second half: traces what is listed, and adds to `raw` or takes from it.
    void trace(const FrameContext& frame, const SceneGpu& scene, const RayList& rays,
               GpuTexture& raw, Kind kind);

private:
    ShaderLibrary& shaders_;
};

} // namespace afterglow
