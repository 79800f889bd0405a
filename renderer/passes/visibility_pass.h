// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"
#include "renderer/resources/render_targets.h"
#include "renderer/resources/scene_gpu.h"

namespace afterglow {

/// Rasterizes every instance and makes a visibility sample and a seed of every pixel.
/// See shaders/scene/visibility.vert and resolve.comp. Reads the frame block.
class VisibilityPass {
public:
    struct Outputs {
        const Framebuffer& framebuffer; ///< ids and depth
        const GpuTexture& ids;
        GpuTexture& visibility;
        GpuTexture& seeds;
    };

    explicit VisibilityPass(ShaderLibrary& shaders);
    void run(FrameContext& frame, const SceneGpu& scene, const Outputs& out);

private:
    void rasterize(const FrameContext& frame, const SceneGpu& scene,
                   const Framebuffer& framebuffer);
    void resolve(const FrameContext& frame, const SceneGpu& scene, const Outputs& out);

    RasterProgram& raster_;
    ComputeProgram& resolve_;
    GlObject<VertexArrayKind> vertexArray_;
};

} // namespace afterglow
