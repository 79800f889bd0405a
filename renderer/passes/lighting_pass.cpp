// SPDX-License-Identifier: MIT
#include "renderer/passes/lighting_pass.h"

namespace afterglow {

namespace {

Defines definesOf(LightingPass::Kind kind) {
    return {{kind == LightingPass::Kind::Shadow ? "SHADOWS" : "AMBIENT_OCCLUSION", "1"}};
}

} // namespace

void LightingPass::run(FrameContext& frame, const SceneGpu& scene, const Inputs& in,
                       const Outputs& out, Rays rays) {
    const auto scope = frame.pass("lighting", {&out.raw});
    bool isFirst = true;
    const auto kind = [&](Kind one) {
        list(frame, scene, in, out, one, isFirst);
        trace(frame, scene, out.rays, out.raw, one);
        isFirst = false;
    };
    if (rays.shadows)
        kind(Kind::Shadow);
    if (rays.ambientOcclusion)
        kind(Kind::AmbientOcclusion);
    shaders_.compute("lighting/finish.comp")
        .dispatch(out.raw.size(), {frame.block()}, {{"raw", out.raw}, {"counters", out.counters}});
}

void LightingPass::list(const FrameContext& frame, const SceneGpu& scene, const Inputs& in,
                        const Outputs& out, Kind kind, bool isFirst) {
    Defines defines = definesOf(kind);
    if (isFirst)
        defines.emplace_back("FIRST", "1");
    // A program has among its inputs what its rays need, and nothing else.
    std::vector<Binding> reads{frame.block(),
                               {"surface", in.surfaces.surface},
                               {"guides", in.surfaces.guides},
                               {"seeds", in.seeds},
                               {"noiseTile", scene.noiseTile}};
    if (kind == Kind::Shadow) {
        reads.emplace_back("lightTriangles", scene.lightTriangles);
        reads.emplace_back("lightScales", scene.lightScales);
    } else {
        reads.emplace_back("visibility", in.surfaces.visibility);
        reads.emplace_back("instances", scene.instances);
    }
    std::vector<Binding> writes{
        {"rays", out.rays.rays}, {"rayCounts", out.rays.counts}, {"counters", out.counters}};
    if (isFirst)
        writes.emplace_back("raw", out.raw);
    shaders_.compute("lighting/rays.comp", defines)
        .dispatch(out.raw.size(), std::span<const Binding>(reads), writes);
}

void LightingPass::trace(const FrameContext& frame, const SceneGpu& scene, const RayList& rays,
                         GpuTexture& raw, Kind kind) {
    std::vector<Binding> reads{
        {"bvhRecords", scene.bvhRecords}, {"rays", rays.rays}, {"rayCounts", rays.counts}};
    if (kind == Kind::AmbientOcclusion)
        reads.push_back(frame.block());
    const Binding writes[] = {{"raw", raw}};
    shaders_.compute("lighting/trace.comp", definesOf(kind))
        .dispatch(invocationsOf(raw.size()), std::span<const Binding>(reads), writes);
}

} // namespace afterglow
