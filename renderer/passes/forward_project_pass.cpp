#include "renderer/passes/forward_project_pass.h"

namespace afterglow {

ForwardProjectPass::ForwardProjectPass(ShaderLibrary& shaders)
    : claim_(shaders.compute("denoise/forward_claim.comp")),
      merge_(shaders.compute("denoise/forward_merge.comp")) {}

void ForwardProjectPass::run(FrameContext& frame, const SceneGpu& scene, const Inputs& in,
                             const Outputs& out) {
    const auto scope = frame.timer.scope("forward projection");
    out.owners.clear();
    claim_.dispatch(out.owners.size(),
                    {{"previousVisibility", in.previousVisibility},
                     {"previousSeeds", in.previousSeeds},
                     {"visibility", out.visibility},
                     {"vertices", scene.vertices},
                     {"triangles", scene.triangles},
                     {"instances", scene.instances}},
                    {{"owners", out.owners}});
    merge_.dispatch(out.owners.size(),
                    {{"owners", out.owners},
                     {"previousVisibility", in.previousVisibility},
                     {"previousSeeds", in.previousSeeds},
                     {"previousRaw", in.previousRaw},
                     {"vertices", scene.vertices},
                     {"triangles", scene.triangles},
                     {"instances", scene.instances}},
                    {{"visibility", out.visibility},
                     {"seeds", out.seeds},
                     {"samples", out.samples},
                     {"counters", out.counters}});
}

} // namespace afterglow
