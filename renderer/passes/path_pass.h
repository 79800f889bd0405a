// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"
#include "renderer/resources/path_targets.h"
#include "renderer/resources/scene_gpu.h"
#include "renderer/resources/surfaces.h"

#include <optional>

namespace afterglow {

/// One path of two segments a pixel: the light of the area lights and of one other surface, with
/// all lobes of the materials. See docs/pipeline.md, "Paths". Reads the frame block.
class PathPass {
public:
    /// The signals that the parts of the light form: `kPath...` in shared/path.h.
    enum class Division { Whole, Lobes, Segments };
    /// Returns the number of signals of a division.
    static std::size_t signalsOf(Division division) { return division == Division::Whole ? 1 : 2; }

    struct Inputs {
        const Surfaces& surfaces;
        const GpuTexture& seeds;
    };
    struct Outputs {
        std::span<GpuTexture* const> raw; ///< by signal
        RayList& rays;                    ///< all three of at least the size of the seeds
        PathTargets& paths;
        GpuTexture& counters;
    };

    explicit PathPass(ShaderLibrary& shaders) : shaders_(shaders) {}
    void run(FrameContext& frame, const SceneGpu& scene, const Inputs& in, const Outputs& out,
             Division division);

    /// Makes what each signal is to be multiplied with after the filter.
    void divide(FrameContext& frame, const SceneGpu& scene, const Surfaces& surfaces,
                std::span<GpuTexture* const> divisors, Division division);

    /// Makes the motion of what surfaces mirror, from the distances that the last run has left: as
    /// Surfaces::motion, which it is where nothing is mirrored.
    void reflect(FrameContext& frame, const SceneGpu& scene, const Surfaces& surfaces,
                 const PathTargets& paths, GpuTexture& reflected);

private:
    struct Call; // what the steps of a path share
    void light(const Call& call);
    void scatter(const Call& call);
    void bounce(const Call& call);
    const GpuTexture& specularAlbedo();

    ShaderLibrary& shaders_;
    std::optional<GpuTexture> specularAlbedo_; ///< made when it is first needed
};

} // namespace afterglow
