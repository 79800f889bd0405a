// SPDX-License-Identifier: MIT
#include "renderer/passes/lighting_pass.h"

namespace afterglow {

void LightingPass::run(FrameContext& frame, const SceneGpu& scene, const Inputs& in,
                       const Outputs& out, Rays rays) {
    const auto scope = frame.pass("lighting", {&out.raw});
    const auto trace = [&](const Defines& defines, std::initializer_list<Binding> reads) {
        shaders_.compute("lighting/lighting.comp", defines)
            .dispatch(out.raw.size(), reads, {{"raw", out.raw}, {"counters", out.counters}});
    };
    // A program has among its inputs what its rays need, and nothing else.
    if (!rays.ambientOcclusion)
        trace({{"SHADOWS", "1"}}, {frame.block(),
                                   {"surface", in.surfaces.surface},
                                   {"guides", in.surfaces.guides},
                                   {"seeds", in.seeds},
                                   {"noiseTile", scene.noiseTile},
                                   {"lightTriangles", scene.lightTriangles},
                                   {"lightScales", scene.lightScales},
                                   {"bvhNodes", scene.bvhNodes},
                                   {"bvhTriangles", scene.bvhTriangles},
                                   {"bvhInstances", scene.bvhInstances}});
    else if (!rays.shadows)
        trace({{"AMBIENT_OCCLUSION", "1"}}, {frame.block(),
                                             {"visibility", in.surfaces.visibility},
                                             {"surface", in.surfaces.surface},
                                             {"guides", in.surfaces.guides},
                                             {"seeds", in.seeds},
                                             {"noiseTile", scene.noiseTile},
                                             {"instances", scene.instances},
                                             {"bvhNodes", scene.bvhNodes},
                                             {"bvhTriangles", scene.bvhTriangles},
                                             {"bvhInstances", scene.bvhInstances}});
    else
        trace({{"SHADOWS", "1"}, {"AMBIENT_OCCLUSION", "1"}},
              {frame.block(),
               {"visibility", in.surfaces.visibility},
               {"surface", in.surfaces.surface},
               {"guides", in.surfaces.guides},
               {"seeds", in.seeds},
               {"noiseTile", scene.noiseTile},
               {"instances", scene.instances},
               {"lightTriangles", scene.lightTriangles},
               {"lightScales", scene.lightScales},
               {"bvhNodes", scene.bvhNodes},
               {"bvhTriangles", scene.bvhTriangles},
               {"bvhInstances", scene.bvhInstances}});
}

} // namespace afterglow
