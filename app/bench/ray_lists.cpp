// SPDX-License-Identifier: MIT
#include "app/bench/ray_lists.h"

namespace afterglow {

namespace {

TexelBuffer hitsOf(glm::ivec2 size) {
    const glm::ivec2 places = invocationsOf(size);
    return TexelBuffer("ray hits",
                       std::size_t(places.x) * std::size_t(places.y) * sizeof(glm::uvec4));
}

bool isOfFrame(RayKind kind) {
    return kind == RayKind::Shadow || kind == RayKind::AmbientOcclusion;
}

LightingPass::Kind lightingKind(RayKind kind) {
    return kind == RayKind::Shadow ? LightingPass::Kind::Shadow
                                   : LightingPass::Kind::AmbientOcclusion;
}

/// Calls use(place) for each place of a list that has a ray, in order.
template <class Use>
void forEachPlace(const RayList& list, const Use& use) {
    const auto counts = list.counts.read<std::uint32_t>();
    for (std::size_t segment = 0; segment < counts.size(); ++segment)
        for (std::uint32_t i = 0; i < counts[segment]; ++i)
            use(segment * gpu::kSegmentRays + i);
}

} // namespace

std::string_view nameOf(RayKind kind) {
    switch (kind) {
    case RayKind::Shadow: return "shadow";
    case RayKind::AmbientOcclusion: return "ao";
    case RayKind::Closest: return "closest";
    case RayKind::Bounce: return "bounce";
    case RayKind::BounceShadow: break;
    }
    return "bounce_shadow";
}

bool isAnyHit(RayKind kind) {
    return kind != RayKind::Closest && kind != RayKind::Bounce;
}

RayLists::RayLists(Renderer& renderer, ShaderLibrary& shaders)
    : shaders_(shaders), call_(renderer.lightingCall(0)), lighting_(shaders),
      size_(renderer.size()), rays_(size_), bounces_(size_), hits_(hitsOf(size_)),
      bounceHits_(hitsOf(size_)) {}

const RayList& RayLists::current() const {
    return isOfFrame(kind_) ? call_.out.rays : kind_ == RayKind::Bounce ? bounces_ : rays_;
}

void RayLists::list(RayKind kind) {
    kind_ = kind;
    switch (kind) {
    case RayKind::Shadow:
    case RayKind::AmbientOcclusion:
        lighting_.list(call_.context, call_.scene, call_.in, call_.out, lightingKind(kind), true);
        break;
    case RayKind::Closest: listOwn("PRIMARY", rays_); break;
    case RayKind::Bounce: listOwn("BOUNCE", bounces_); break;
    case RayKind::BounceShadow:
        listOwn("BOUNCE", bounces_);
        traceOwn(bounces_, bounceHits_, false);
        listOwn("BOUNCE_SHADOW", rays_);
        break;
    }
}

void RayLists::listOwn(const char* define, RayList& to) {
    std::vector<Binding> reads{call_.context.block()};
    if (&to == &bounces_) {
        reads.emplace_back("surface", call_.in.surfaces.surface);
        reads.emplace_back("guides", call_.in.surfaces.guides);
        reads.emplace_back("visibility", call_.in.surfaces.visibility);
        reads.emplace_back("instances", call_.scene.instances);
    } else if (kind_ == RayKind::BounceShadow) {
        const SceneGpu& scene = call_.scene;
        reads.insert(reads.end(), {{"bounces", bounces_.rays},
                                   {"bounceCounts", bounces_.counts},
                                   {"bounceHits", bounceHits_},
                                   {"vertices", scene.vertices},
                                   {"triangles", scene.triangles},
                                   {"instances", scene.instances},
                                   {"lightTriangles", scene.lightTriangles},
                                   {"lightScales", scene.lightScales}});
    }
    const Binding writes[] = {
        {"rays", to.rays}, {"rayCounts", to.counts}, {"counters", call_.out.counters}};
    shaders_.compute("bench/rays.comp", {{define, "1"}})
        .dispatch(size_, std::span<const Binding>(reads), writes);
}

void RayLists::traceOwn(const RayList& rays, TexelBuffer& hits, bool anyHit) {
    shaders_.compute(anyHit ? "bench/trace_any.comp" : "lighting/trace_closest.comp")
        .dispatch(invocationsOf(size_),
                  {{"bvhRecords", call_.scene.bvhRecords},
                   {"rays", rays.rays},
                   {"rayCounts", rays.counts}},
                  {{"hits", hits}});
}

void RayLists::trace() {
    if (isOfFrame(kind_))
        lighting_.trace(call_.context, call_.scene, call_.out.rays, call_.out.raw,
                        lightingKind(kind_));
    else
        traceOwn(current(), hits_, isAnyHit(kind_));
}

std::vector<ListedRay> RayLists::read() const {
    const auto all = current().rays.read<ListedRay>();
    std::vector<ListedRay> rays;
    forEachPlace(current(), [&](std::size_t place) { rays.push_back(all[place]); });
    return rays;
}

std::vector<std::uint8_t> RayLists::traceForHits() {
    traceOwn(current(), hits_, isAnyHit(kind_));
    const auto all = hits_.read<glm::uvec4>();
    std::vector<std::uint8_t> hits;
    forEachPlace(current(),
                 [&](std::size_t place) { hits.push_back(all[place].x != gpu::kBvhNoInstance); });
    return hits;
}

} // namespace afterglow
