// SPDX-License-Identifier: MIT
#include "renderer/passes/surface_pass.h"

namespace afterglow {

SurfacePass::SurfacePass(ShaderLibrary& shaders)
    : program_(shaders.compute("scene/surface.comp")) {}

void SurfacePass::run(FrameContext& frame, const SceneGpu& scene, Surfaces& s) {
    const auto scope =
        frame.pass("surface", {&s.surface, &s.guides, &s.slope, &s.motion, &s.albedo, &s.emission});
    program_.dispatch(s.size(),
                      {frame.block(),
                       {"visibility", s.visibility},
                       {"vertices", scene.vertices},
                       {"triangles", scene.triangles},
                       {"instances", scene.instances},
                       {"materials", scene.materials},
                       {"lightScales", scene.lightScales}},
                      {{"surface", s.surface},
                       {"guides", s.guides},
                       {"slope", s.slope},
                       {"motion", s.motion},
                       {"albedo", s.albedo},
                       {"emission", s.emission}});
}

} // namespace afterglow
