#include "renderer/passes/surface_pass.h"

namespace afterglow {

SurfacePass::SurfacePass(ShaderLibrary& shaders)
    : program_(shaders.compute("scene/surface.comp")) {}

void SurfacePass::run(FrameContext& frame, const SceneGpu& scene, const Inputs& in,
                      const Outputs& out) {
    const auto scope = frame.pass("surface", {&out.surface, &out.guides, &out.slope, &out.motion,
                                              &out.albedo, &out.emission});
    program_.dispatch(out.surface.size(),
                      {{"visibility", in.visibility},
                       {"vertices", scene.vertices},
                       {"triangles", scene.triangles},
                       {"instances", scene.instances},
                       {"materials", scene.materials},
                       {"lightScales", scene.lightScales}},
                      {{"surface", out.surface},
                       {"guides", out.guides},
                       {"slope", out.slope},
                       {"motion", out.motion},
                       {"albedo", out.albedo},
                       {"emission", out.emission}});
}

} // namespace afterglow
