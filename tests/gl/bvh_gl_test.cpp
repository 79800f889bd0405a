// SPDX-License-Identifier: MIT
// The GLSL walk against Embree: same hits, same triangles, but for rays that touch an edge or meet
// two triangles at one distance. Each such excuse is checked in double precision, counted and
// bounded.

#include "renderer/bvh/scene_bvh.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"
#include "renderer/scene/procedural.h"
#include "tests/gl/binary_bvh.h"
#include "tests/gl/bvh_rays.h"
#include "tests/gl/embree_judge.h"
#include "tests/support/gl_fixture.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace afterglow;
using namespace afterglow::test;

namespace {

constexpr std::string_view kShader = R"(#version 450
#include "shared/bindings.h"

layout(local_size_x = 64) in;
#include "lib/bvh_trace.glsl"
// WALK

Uint4Buffer(rays); // origin, tMax; direction, unused
writeonly uniform uimage2D hits;      // t, instance, triangle, whether the any-hit query found one
writeonly uniform image2D barycentrics;

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = imageSize(hits);
    if (any(greaterThanEqual(p, size)))
        return;
    int ray = p.y * size.x + p.x;
    vec4 a = uintBitsToFloat(fetchBuffer(rays, 2 * ray));
    vec4 b = uintBitsToFloat(fetchBuffer(rays, 2 * ray + 1));
    BvhHit hit, anything;
    TRACE(a.xyz, b.xyz, a.w, false, hit);
    bool anyHit = TRACE(a.xyz, b.xyz, a.w, true, anything);
    imageStore(hits, p, uvec4(floatBitsToUint(hit.t), hit.instance, hit.triangle, uint(anyHit)));
    imageStore(barycentrics, p, vec4(hit.barycentrics, 0.0, 0.0));
}
)";

enum class FetchBy { Default, Image, Sampler };

template <class Values>
TexelBuffer uploaded(std::string_view label, const Values& values) {
    TexelBuffer buffer(label, values.size() * sizeof(values[0]));
    buffer.write(values);
    return buffer;
}

/// Both queries of each ray; their number is a multiple of 512. `walk` is GLSL that may stand
/// between the program's walk and the shader, and `trace` the function that is called.
std::vector<Hit> traceWith(std::string_view walk, std::string_view trace,
                           const std::vector<GpuRay>& rays, std::vector<Binding> reads,
                           FetchBy fetchBy = FetchBy::Default) {
    const ShaderLibrary& shaders = testShaders();
    Defines defines = shaders.common();
    defines.emplace_back("TRACE", trace);
    if (fetchBy != FetchBy::Default)
        std::erase_if(defines, [](const auto& define) { return define.first == "FETCH_BY_IMAGE"; });
    if (fetchBy == FetchBy::Image)
        defines.emplace_back("FETCH_BY_IMAGE", "1");
    std::string text(kShader);
    constexpr std::string_view kMark = "// WALK";
    text.replace(text.find(kMark), kMark.size(), walk);
    ComputeProgram program("bvh test", shaders.source().expandText("bvh test", text, defines));
    const TexelBuffer rayBuffer = uploaded("rays", rays);
    reads.emplace_back("rays", rayBuffer);

    const glm::ivec2 size(512, int(rays.size() / 512));
    REQUIRE(std::size_t(size.x * size.y) == rays.size());
    GpuTexture hits("hits", PixelFormat::RGBA32UI, size);
    GpuTexture barycentrics("barycentrics", PixelFormat::RG32F, size);
    const Binding writes[] = {{"hits", hits}, {"barycentrics", barycentrics}};
    program.dispatch(size, std::span<const Binding>(reads), writes);

    const auto hitPixels = hits.read<glm::uvec4>();
    const auto barycentricPixels = barycentrics.read<glm::vec2>();
    std::vector<Hit> result(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const glm::uvec4 h = hitPixels.pixels()[i];
        result[i] = {.t = glm::uintBitsToFloat(h.x),
                     .instance = h.y,
                     .triangle = h.z,
                     .barycentrics = barycentricPixels.pixels()[i],
                     .any = h.w != 0};
    }
    return result;
}

std::vector<Hit> traceWithGlsl(const SceneBvh& bvh, const std::vector<GpuRay>& rays,
                               FetchBy fetchBy = FetchBy::Default) {
    testContext();
    const TexelBuffer records = uploaded("records", bvh.records());
    return traceWith("", "bvhTrace", rays, {{"bvhRecords", records}}, fetchBy);
}

/// The same triangles through a tree of two children a node.
std::vector<Hit> traceWithBinaryTree(const std::vector<WorldTriangle>& triangles,
                                     const std::vector<GpuRay>& rays) {
    testContext();
    std::vector<Aabb> boxes;
    std::vector<gpu::BvhTriangle> leaves;
    for (const WorldTriangle& triangle : triangles)
        boxes.push_back(boundsOf(gpu::BvhTriangle{.v0 = triangle.corners[0],
                                                  .instance = 0,
                                                  .v1 = triangle.corners[1],
                                                  .triangle = 0,
                                                  .v2 = triangle.corners[2],
                                                  .next = 0}));
    const BinaryBvh tree = buildBinaryBvh(boxes);
    for (const std::uint32_t i : tree.order)
        leaves.push_back({.v0 = triangles[i].corners[0],
                          .instance = triangles[i].instance,
                          .v1 = triangles[i].corners[1],
                          .triangle = triangles[i].triangle,
                          .v2 = triangles[i].corners[2],
                          .next = 0});
    const TexelBuffer nodes = uploaded("nodes", tree.nodes);
    const TexelBuffer packed = uploaded("triangles", leaves);
    return traceWith(kBinaryTrace, "binaryTrace", rays,
                     {{"binaryNodes", nodes}, {"binaryTriangles", packed}});
}

constexpr std::size_t kRays = 512 * 256;

/// All that is hit is hit at the same distance, to the bit: the walks differ only in the order in
/// which they meet what is there. Where two triangles are at one distance, either may come first.
void compareWithBinaryTree(const std::vector<Hit>& ours, const std::vector<Hit>& theirs,
                           int mostCoincident) {
    int distance = 0, any = 0, triangle = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        distance += ours[i].closest() != theirs[i].closest() || ours[i].t != theirs[i].t;
        any += ours[i].any != theirs[i].any;
        triangle += ours[i].instance != theirs[i].instance ||
                    ours[i].triangle != theirs[i].triangle ||
                    ours[i].barycentrics != theirs[i].barycentrics;
    }
    MESSAGE("against a tree of two children a node: ", triangle, " of ", ours.size(),
            " rays name another triangle at the same distance");
    CHECK(distance == 0);
    CHECK(any == 0);
    CHECK(triangle <= mostCoincident + 20);
}

/// `mostCoincident`: of rays whose nearest hit is on two surfaces at once, which the scene decides.
void compareWithEmbree(const Scene& scene, const SceneBvh& bvh, const Pose& pose, Random& random,
                       int mostCoincident = 0) {
    const std::vector<WorldTriangle> triangles = worldTriangles(scene, pose);
    const std::vector<GpuRay> rays = raysAround(triangles, kRays, random);
    const std::vector<Hit> ours = traceWithGlsl(bvh, rays);
    compareWithBinaryTree(ours, traceWithBinaryTree(triangles, rays), mostCoincident);
    const EmbreeScene embree(triangles);
    const Judge judge(triangles, scene.instances.size());

    int hits = 0, edges = 0, coincident = 0, wrong = 0, anyTies = 0, anyWrong = 0, inconsistent = 0;
    double worst = 0.0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Hit theirs = embree.trace(rays[i]);
        const bool same = ours[i].instance == theirs.instance &&
                          (!theirs.closest() || ours[i].triangle == theirs.triangle);
        if (!same) {
            const Judge::Verdict verdict = judge.judge(rays[i], ours[i], theirs);
            edges += verdict == Judge::Verdict::Edge;
            coincident += verdict == Judge::Verdict::Coincident;
            wrong += verdict == Judge::Verdict::Wrong;
        } else if (theirs.closest()) {
            worst = std::max(worst, judge.error(rays[i], ours[i]));
        }
        if (ours[i].closest()) {
            ++hits;
            inconsistent += !judge.consistent(rays[i], ours[i]);
        }
        if (ours[i].any != theirs.any) {
            const bool tie = judge.tieOfAny(rays[i]);
            anyTies += tie;
            anyWrong += !tie;
        }
    }
    MESSAGE(triangles.size(), " triangles, ", rays.size(), " rays, ", hits,
            " hits; nearest: ", edges, " within ", judge.edge() * 1e6, " micrometres of an edge, ",
            coincident, " on coincident surfaces, ", wrong, " wrong; any: ", anyTies, " ties, ",
            anyWrong, " wrong; worst t: ", worst, " of the tolerance");
    CHECK(hits > int(kRays / 4));
    CHECK(wrong == 0);
    CHECK(anyWrong == 0);
    CHECK(inconsistent == 0);
    CHECK(worst <= 1.0);
    CHECK(edges <= int(kRays / 10000)); // measured: 0 to 4 of 131072
    CHECK(coincident <= mostCoincident);
    CHECK(anyTies <= 3); // measured: 0
}

} // namespace

TEST_CASE("the GLSL walk hits what Embree hits in a cluttered hall") {
    Random random(1);
    const Scene scene = sceneOf(clutteredHall(random));
    REQUIRE(scene.meshes[0].triangles.size() > 100000);
    compareWithEmbree(scene, SceneBvh(scene), poseAt(scene, 0.0), random);
}

TEST_CASE("the GLSL walk hits what Embree hits among moving instances, wherever they have gone") {
    Random random(2);
    const Scene scene = movingThings(random);
    SceneBvh bvh(scene);
    REQUIRE(bvh.movingInstances() == 40);
    for (const double seconds : {0.0, 0.6}) {
        const Pose pose = poseAt(scene, seconds);
        bvh.refresh(pose);
        compareWithEmbree(scene, bvh, pose, random);
    }
}

TEST_CASE("the GLSL walk hits what Embree hits in the hall that is shipped") {
    Random random(3);
    const Scene scene = makeProceduralScene("hall");
    SceneBvh bvh(scene);
    const Pose pose = poseAt(scene, 0.5 * duration(scene));
    bvh.refresh(pose);
    compareWithEmbree(scene, bvh, pose, random, int(kRays / 200)); // things stand against walls
}

TEST_CASE("the GLSL walk gives the same bits whether texels come from images or from samplers") {
    Random random(4);
    const Scene scene = movingThings(random);
    const SceneBvh bvh(scene);
    const std::vector<GpuRay> rays =
        raysAround(worldTriangles(scene, poseAt(scene, 0.0)), 512 * 32, random);
    const std::vector<Hit> byImage = traceWithGlsl(bvh, rays, FetchBy::Image);
    const std::vector<Hit> bySampler = traceWithGlsl(bvh, rays, FetchBy::Sampler);
    CHECK(byImage == bySampler);
}

TEST_CASE("rays along an axis hit a flat grid at its corners and its border too") {
    Mesh mesh;
    addSquare(mesh, {0, 0, 0}, {8, 0, 0}, {0, 0, 8}, 8); // exact in binary
    const SceneBvh bvh(sceneOf(std::move(mesh)));
    std::vector<GpuRay> rays;
    for (int i = 0; i < 1024; ++i)
        rays.push_back({.origin = {0.5f * float(i % 32) - 3.0f, 2.0f, 0.5f * float(i / 32) - 3.0f},
                        .tMax = INFINITY,
                        .direction = {0.0f, -1.0f, 0.0f}});
    const std::vector<Hit> hits = traceWithGlsl(bvh, rays);
    int wrong = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const glm::vec3 o = rays[i].origin;
        const bool over = o.x >= 0.0f && o.x <= 8.0f && o.z >= 0.0f && o.z <= 8.0f;
        wrong += hits[i].any != over || hits[i].closest() != over || (over && hits[i].t != 2.0f);
    }
    CHECK(wrong == 0);
}

TEST_CASE("a scene without triangles lets every ray of the GLSL walk pass") {
    const SceneBvh bvh{Scene{}};
    const std::vector<GpuRay> rays(
        512, GpuRay{.origin = {}, .tMax = INFINITY, .direction = {0.0f, 0.0f, 1.0f}});
    for (const Hit& hit : traceWithGlsl(bvh, rays)) {
        REQUIRE_FALSE(hit.closest());
        REQUIRE_FALSE(hit.any);
    }
}

TEST_CASE("one moving instance is found by the GLSL walk") { // its top-level root has one child
    Mesh square;
    addSquare(square, {-1, 0, -1}, {2, 0, 0}, {0, 0, 2}, 1);
    Scene scene;
    scene.materials.emplace_back();
    scene.meshes.push_back(square);
    Node node;
    node.translation = {5.0f, 0.0f, 0.0f};
    scene.instances.push_back({.mesh = 0, .material = 0, .node = addNode(scene, node)});
    scene.tracks.push_back({.node = 0, .times = {0.0}, .values = {{5.0f, 0.0f, 0.0f, 0.0f}}});
    const SceneBvh bvh(scene);
    std::vector<GpuRay> rays;
    for (int i = 0; i < 512; ++i)
        rays.push_back({.origin = {float(i % 10), 2.0f, 0.25f},
                        .tMax = INFINITY,
                        .direction = {0.0f, -2.0f, 0.0f}});
    const std::vector<Hit> hits = traceWithGlsl(bvh, rays);
    for (int i = 0; i < 512; ++i) {
        const bool over = i % 10 >= 4 && i % 10 <= 6;
        CHECK(hits[std::size_t(i)].closest() == over);
        CHECK(hits[std::size_t(i)].any == over);
        if (over)
            CHECK(hits[std::size_t(i)].t == 1.0f);
    }
}
