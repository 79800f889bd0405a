// SPDX-License-Identifier: MIT
#include "renderer/passes/path_pass.h"

#include "renderer/resources/specular_albedo.h"

#include <algorithm>

namespace afterglow {

namespace {

Defines definesOf(PathPass::Division division) {
    return {{"PATH_DIVISION", std::to_string(int(division))}};
}

Defines traceDefines(const char* kind, std::size_t signals) {
    return {{kind, "1"}, {"SIGNALS", std::to_string(signals)}};
}

} // namespace

struct PathPass::Call {
    const FrameContext& frame;
    const SceneGpu& scene;
    const Inputs& in;
    const Outputs& out;
    Division division;
    const GpuTexture& specularAlbedo;

    glm::ivec2 size() const { return in.seeds.size(); }
    bool isOfLobes() const { return division == Division::Lobes; }

    /// Returns the inputs of programs that know the visible point.
    std::vector<Binding> visiblePoint() const {
        std::vector<Binding> reads = surfaces(frame, scene, in.surfaces, specularAlbedo);
        reads.emplace_back("seeds", in.seeds);
        reads.emplace_back("noiseTile", scene.noiseTile);
        return reads;
    }
    static std::vector<Binding> surfaces(const FrameContext& frame, const SceneGpu& scene,
                                         const Surfaces& surfaces, const GpuTexture& albedo) {
        return {frame.block(),
                {"visibility", surfaces.visibility},
                {"surface", surfaces.surface},
                {"guides", surfaces.guides},
                {"instances", scene.instances},
                {"materials", scene.materials},
                {"specularAlbedo", albedo}};
    }
    void addLights(std::vector<Binding>& reads) const {
        reads.emplace_back("lightTriangles", scene.lightTriangles);
        reads.emplace_back("lightScales", scene.lightScales);
    }
    std::vector<Binding> lists(const RayList& rays) const {
        return {{"rays", rays.rays}, {"rayCounts", rays.counts}, {"counters", out.counters}};
    }
};

void PathPass::run(FrameContext& frame, const SceneGpu& scene, const Inputs& in, const Outputs& out,
                   Division division) {
    const Call call{frame, scene, in, out, division, specularAlbedo()};
    const auto scope = frame.pass("paths", {out.raw.front(), out.raw.back()});
    light(call);
    scatter(call);
    bounce(call);
    for (GpuTexture* raw : out.raw)
        shaders_.compute("lighting/finish.comp")
            .dispatch(call.size(), {frame.block()}, {{"raw", *raw}, {"counters", out.counters}});
}

// Adds the light that reaches the visible surface from a point on a light.
void PathPass::light(const Call& call) {
    std::vector<Binding> reads = call.visiblePoint();
    call.addLights(reads);
    std::vector<Binding> writes = call.lists(call.out.rays);
    writes.emplace_back("raw0", *call.out.raw[0]);
    if (call.out.raw.size() > 1)
        writes.emplace_back("raw1", *call.out.raw[1]);
    shaders_.compute("lighting/path_light.comp", definesOf(call.division))
        .dispatch(call.size(), std::span<const Binding>(reads), writes);

    // The second of two segments gets nothing from this light sample.
    const std::size_t lit = call.isOfLobes() ? 2 : 1;
    reads = {{"bvhRecords", call.scene.bvhRecords},
             {"rays", call.out.rays.rays},
             {"rayCounts", call.out.rays.counts}};
    writes = {{"raw", *call.out.raw[0]}};
    if (lit > 1)
        writes.emplace_back("raw1", *call.out.raw[1]);
    shaders_.compute("lighting/trace.comp", traceDefines("SHADOWS", lit))
        .dispatch(invocationsOf(call.size()), std::span<const Binding>(reads), writes);
}

// Samples a direction at the visible surface and finds the closest hit along it.
void PathPass::scatter(const Call& call) {
    const std::vector<Binding> reads = call.visiblePoint();
    PathTargets& paths = call.out.paths;
    std::vector<Binding> writes = call.lists(paths.bounces);
    writes.emplace_back("weight0", paths.weights[0]);
    if (call.isOfLobes()) {
        writes.emplace_back("weight1", paths.weights[1]);
        writes.emplace_back("distances", paths.distances);
    }
    shaders_.compute("lighting/path_scatter.comp", definesOf(call.division))
        .dispatch(call.size(), std::span<const Binding>(reads), writes);
    shaders_.compute("lighting/trace_closest.comp")
        .dispatch(invocationsOf(call.size()),
                  {{"bvhRecords", call.scene.bvhRecords},
                   {"rays", paths.bounces.rays},
                   {"rayCounts", paths.bounces.counts}},
                  {{"hits", paths.hits}});
}

// Adds the light that the second surfaces emit, and that they scatter from a point on a light.
void PathPass::bounce(const Call& call) {
    PathTargets& paths = call.out.paths;
    std::vector<Binding> reads{call.frame.block(),
                               {"seeds", call.in.seeds},
                               {"noiseTile", call.scene.noiseTile},
                               {"vertices", call.scene.vertices},
                               {"triangles", call.scene.triangles},
                               {"instances", call.scene.instances},
                               {"materials", call.scene.materials},
                               {"specularAlbedo", call.specularAlbedo},
                               {"bounces", paths.bounces.rays},
                               {"bounceCounts", paths.bounces.counts},
                               {"hits", paths.hits},
                               {"weight0", paths.weights[0]}};
    call.addLights(reads);
    std::vector<Binding> writes = call.lists(call.out.rays);
    writes.emplace_back("raw0", *call.out.raw[0]);
    writes.emplace_back("pending0", paths.pending[0]);
    if (call.isOfLobes()) {
        reads.emplace_back("weight1", paths.weights[1]);
        writes.emplace_back("raw1", *call.out.raw[1]);
        writes.emplace_back("pending1", paths.pending[1]);
        writes.emplace_back("distances", paths.distances);
    }
    shaders_.compute("lighting/path_bounce.comp", definesOf(call.division))
        .dispatch(call.size(), std::span<const Binding>(reads), writes);

    reads = {{"bvhRecords", call.scene.bvhRecords},
             {"rays", call.out.rays.rays},
             {"rayCounts", call.out.rays.counts},
             {"pending", paths.pending[0]}};
    writes = {{"raw", *call.out.raw[call.division == Division::Segments ? 1 : 0]}};
    if (call.isOfLobes()) {
        reads.emplace_back("pending1", paths.pending[1]);
        writes.emplace_back("raw1", *call.out.raw[1]);
    }
    shaders_.compute("lighting/trace.comp", traceDefines("PENDING", call.isOfLobes() ? 2 : 1))
        .dispatch(invocationsOf(call.size()), std::span<const Binding>(reads), writes);
}

void PathPass::divide(FrameContext& frame, const SceneGpu& scene, const Surfaces& surfaces,
                      std::span<GpuTexture* const> divisors, Division division) {
    const auto scope = frame.pass("divisors", {divisors.front(), divisors.back()});
    const std::vector<Binding> reads = Call::surfaces(frame, scene, surfaces, specularAlbedo());
    std::vector<Binding> writes{{"divisor0", *divisors[0]}};
    if (divisors.size() > 1)
        writes.emplace_back("divisor1", *divisors[1]);
    shaders_.compute("lighting/path_divisor.comp", definesOf(division))
        .dispatch(surfaces.size(), std::span<const Binding>(reads), writes);
}

void PathPass::reflect(FrameContext& frame, const SceneGpu& scene, const Surfaces& surfaces,
                       const PathTargets& paths, GpuTexture& reflected) {
    const auto scope = frame.pass("reflected motion", {&reflected});
    shaders_.compute("lighting/reflected_motion.comp")
        .dispatch(surfaces.size(),
                  {frame.block(),
                   {"visibility", surfaces.visibility},
                   {"surface", surfaces.surface},
                   {"guides", surfaces.guides},
                   {"motion", surfaces.motion},
                   {"distances", paths.distances},
                   {"instances", scene.instances},
                   {"materials", scene.materials}},
                  {{"reflected", reflected}});
}

const GpuTexture& PathPass::specularAlbedo() {
    if (!specularAlbedo_) {
        const Image<glm::vec2> table = makeSpecularAlbedo();
        specularAlbedo_.emplace("specular albedo", PixelFormat::RG32F, table.size());
        specularAlbedo_->write(table);
    }
    return *specularAlbedo_;
}

} // namespace afterglow
