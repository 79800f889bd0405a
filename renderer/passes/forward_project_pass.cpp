// SPDX-License-Identifier: MIT
#include "renderer/passes/forward_project_pass.h"

namespace afterglow {

ForwardProjectPass::ForwardProjectPass(ShaderLibrary& shaders)
    : claim_(shaders.compute("denoise/forward_claim.comp")),
      merge_(shaders.compute("denoise/forward_merge.comp")),
      mergeExtra_(shaders.compute("denoise/forward_merge.comp", {{"EXTRA_SAMPLES", "1"}})) {}

void ForwardProjectPass::run(FrameContext& frame, const SceneGpu& scene, const Inputs& in,
                             const Outputs& out) {
    const auto scope =
        frame.pass("forward projection", {&out.visibility, &out.seeds, &out.samples});
    out.owners.clear();
    claim_.dispatch(out.owners.size(),
                    {frame.block(),
                     {"previousVisibility", in.previousVisibility},
                     {"previousSeeds", in.previousSeeds},
                     {"visibility", in.visibility},
                     {"vertices", scene.vertices},
                     {"triangles", scene.triangles},
                     {"instances", scene.instances}},
                    {{"owners", out.owners}, {"claims", out.claims}});
    ComputeProgram& merge = &in.visibility == &out.visibility ? merge_ : mergeExtra_;
    merge.dispatch(out.owners.size(),
                   {frame.block(),
                    {"owners", out.owners},
                    {"claims", out.claims},
                    {"previousVisibility", in.previousVisibility},
                    {"previousSeeds", in.previousSeeds}},
                   {{"visibility", out.visibility},
                    {"seeds", out.seeds},
                    {"samples", out.samples},
                    {"counters", out.counters}});
}

} // namespace afterglow
