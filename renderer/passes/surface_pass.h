// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"
#include "renderer/resources/scene_gpu.h"
#include "renderer/resources/surfaces.h"

namespace afterglow {

/// The surface behind each visibility sample. See shaders/scene/surface.comp. Reads the frame
/// block.
class SurfacePass {
public:
    explicit SurfacePass(ShaderLibrary& shaders);
    /// Makes all images of `surfaces` from its visibility samples.
    void run(FrameContext& frame, const SceneGpu& scene, Surfaces& surfaces);

private:
    ComputeProgram& program_;
};

} // namespace afterglow
