// The GLSL walk against Embree: same hits, same triangles, but for rays that touch an edge or meet
// two triangles at one distance. Each such excuse is checked in double precision, counted and
// bounded.

#include "renderer/bvh/bvh_trace.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"
#include "renderer/scene/procedural.h"
#include "tests/support/gl_fixture.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <embree3/rtcore.h>
#include <glm/gtc/constants.hpp>

using namespace afterglow;

namespace {

// ---------------------------------------------------------------------------------------- scenes

class Random {
public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}

    float unit() { return float(double(engine_()) / 4294967296.0); }
    float between(float low, float high) { return low + (high - low) * unit(); }
    glm::vec3 inBox(glm::vec3 low, glm::vec3 high) {
        const float x = unit(), y = unit(), z = unit(); // in this order, whatever the compiler
        return low + (high - low) * glm::vec3(x, y, z);
    }
    glm::vec3 onSphere() {
        const float z = between(-1.0f, 1.0f), angle = between(0.0f, glm::two_pi<float>());
        const float r = std::sqrt(1.0f - z * z);
        return {r * std::cos(angle), r * std::sin(angle), z};
    }
    std::size_t below(std::size_t end) { return std::size_t(double(unit()) * double(end)) % end; }

private:
    std::mt19937 engine_;
};

/// Adds a surface over [0, 1] x [0, 1] as a net of triangles that share their vertices.
template <class Surface>
void addNet(Mesh& mesh, int columns, int rows, const Surface& surface) {
    const auto first = std::uint32_t(mesh.positions.size());
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i) {
            mesh.positions.push_back(surface(float(i) / float(columns), float(j) / float(rows)));
            mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
        }
    const auto at = [&](int i, int j) { return first + std::uint32_t(j * (columns + 1) + i); };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            mesh.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
            mesh.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
}

void addSphere(Mesh& mesh, glm::vec3 center, float radius, int rings) {
    addNet(mesh, 2 * rings, rings, [&](float u, float v) {
        const float a = u * glm::two_pi<float>(), b = v * glm::pi<float>();
        return center + radius * glm::vec3(std::sin(b) * std::cos(a), std::cos(b),
                                           std::sin(b) * std::sin(a));
    });
}

void addFlutedColumn(Mesh& mesh, glm::vec3 foot, float radius, float height) {
    addNet(mesh, 96, 20, [&](float u, float v) {
        const float a = u * glm::two_pi<float>();
        const float r = radius * (1.0f - 0.08f * std::abs(std::sin(8.0f * a)));
        return foot + glm::vec3(r * std::cos(a), height * v, r * std::sin(a));
    });
}

void addSquare(Mesh& mesh, glm::vec3 corner, glm::vec3 a, glm::vec3 b, int cells) {
    addNet(mesh, cells, cells, [&](float u, float v) { return corner + u * a + v * b; });
}

/// A hall of 24 by 6 by 12 metres with columns, spheres and splinters: more than 100,000 triangles.
Mesh clutteredHall(Random& random) {
    Mesh mesh;
    addSquare(mesh, {-12, 0, -6}, {24, 0, 0}, {0, 0, 12}, 24);
    addSquare(mesh, {-12, 6, -6}, {24, 0, 0}, {0, 0, 12}, 12);
    addSquare(mesh, {-12, 0, -6}, {24, 0, 0}, {0, 6, 0}, 8);
    addSquare(mesh, {-12, 0, 6}, {24, 0, 0}, {0, 6, 0}, 8);
    for (int i = 0; i < 11; ++i)
        for (const float z : {-3.0f, 3.0f})
            addFlutedColumn(mesh, {float(2 * i - 10), 0.0f, z}, 0.35f, 6.0f);
    for (int i = 0; i < 24; ++i)
        addSphere(mesh, random.inBox({-11, 0.3f, -5}, {11, 3, 5}), random.between(0.1f, 0.6f), 20);
    for (int i = 0; i < 3000; ++i) {
        const glm::vec3 center = random.inBox({-11, 0, -5}, {11, 5, 5});
        addNet(mesh, 1, 1, [&](float, float) { return center + 0.15f * random.onSphere(); });
    }
    return mesh;
}

std::uint32_t addNode(Scene& scene, const Node& node) {
    scene.nodes.push_back(node);
    return std::uint32_t(scene.nodes.size() - 1);
}

Scene sceneOf(Mesh mesh) {
    Scene scene;
    scene.materials.emplace_back();
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back({.mesh = 0, .material = 0, .node = addNode(scene, {})});
    return scene;
}

/// A floor and forty things above it that move: turned, squeezed, half of them mirrored.
Scene movingThings(Random& random) {
    Mesh floor;
    addSquare(floor, {-10, 0, -10}, {20, 0, 0}, {0, 0, 20}, 16);
    Scene scene = sceneOf(std::move(floor));
    for (const int rings : {6, 20, 48}) {
        Mesh mesh;
        addSphere(mesh, {0.2f, 0.0f, 0.1f}, 1.0f, rings);
        scene.meshes.push_back(std::move(mesh));
    }
    for (std::uint32_t i = 0; i < 40; ++i) {
        Node node;
        node.translation = random.inBox({-8, 0.5f, -8}, {8, 4, 8});
        node.rotation = glm::angleAxis(random.between(0.0f, 6.0f), random.onSphere());
        node.scale = random.inBox(glm::vec3(0.2f), glm::vec3(1.2f));
        node.scale.x *= i % 2 == 0 ? 1.0f : -1.0f;
        const std::uint32_t index = addNode(scene, node);
        scene.instances.push_back({.mesh = 1 + i % 3, .material = 0, .node = index});
        scene.tracks.push_back({.node = index,
                                .path = Track::Path::Translation,
                                .interpolation = Track::Interpolation::Linear,
                                .times = {0.0, 1.0},
                                .values = {glm::vec4(node.translation, 0.0f),
                                           glm::vec4(random.inBox({-8, 0.5f, -8}, {8, 4, 8}), 0)}});
    }
    return scene;
}

// ------------------------------------------------------------------------------------------ rays

struct GpuRay { // two texels
    glm::vec3 origin;
    float tMax;
    glm::vec3 direction;
    std::uint32_t pad = 0;
};

struct Hit {
    float t = 0.0f;
    std::uint32_t instance = gpu::kBvhNone, triangle = 0;
    glm::vec2 barycentrics{0.0f};
    bool any = false; ///< what the any-hit query says
    bool closest() const { return instance != gpu::kBvhNone; }
    bool operator==(const Hit&) const = default;
};

struct WorldTriangle {
    std::uint32_t instance, triangle;
    glm::vec3 corners[3];
};

/// The scene as it stands, as triangles of the world, rounded once.
std::vector<WorldTriangle> worldTriangles(const Scene& scene, const Pose& pose) {
    std::vector<WorldTriangle> all;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const glm::dmat4 matrix(pose.worldFromNode[instance.node]);
        const Mesh& mesh = scene.meshes[instance.mesh];
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            WorldTriangle triangle{.instance = i, .triangle = t, .corners = {}};
            for (int c = 0; c < 3; ++c)
                triangle.corners[c] =
                    glm::vec3(matrix * glm::dvec4(mesh.positions[mesh.triangles[t][c]], 1.0));
            all.push_back(triangle);
        }
    }
    return all;
}

struct SurfacePoint {
    glm::vec3 position, normal;
};

SurfacePoint pointOnSurface(const std::vector<WorldTriangle>& triangles, Random& random) {
    for (;;) {
        const auto& c = triangles[random.below(triangles.size())].corners;
        const glm::vec3 normal = glm::cross(c[1] - c[0], c[2] - c[0]);
        if (glm::length(normal) < 1e-6f) // the poles of the spheres
            continue;
        const float u = random.unit(), v = random.unit() * (1.0f - u);
        const float side = random.unit() < 0.5f ? -1.0f : 1.0f;
        const glm::vec3 n = glm::normalize(normal) * side;
        return {c[0] + u * (c[1] - c[0]) + v * (c[2] - c[0]) + 1e-3f * n, n};
    }
}

/// Equal parts of bounce rays, short occlusion rays, shadow segments and rays along the axes.
std::vector<GpuRay> raysAround(const std::vector<WorldTriangle>& triangles, std::size_t count,
                               Random& random) {
    glm::vec3 low(1e30f), high(-1e30f);
    for (const WorldTriangle& triangle : triangles)
        for (const glm::vec3& corner : triangle.corners) {
            low = glm::min(low, corner);
            high = glm::max(high, corner);
        }
    std::vector<GpuRay> rays;
    for (std::size_t i = 0; i < count; ++i) {
        const SurfacePoint from = pointOnSurface(triangles, random);
        GpuRay ray{.origin = from.position, .tMax = INFINITY, .direction = {}};
        switch (i % 4) {
        case 0:
        case 1:
            ray.direction = glm::normalize(from.normal + 0.999f * random.onSphere());
            ray.tMax = i % 4 == 0 ? INFINITY : 1.5f;
            break;
        case 2:
            ray.direction = random.inBox({-2, 5.9f, -2}, {2, 5.9f, 2}) - ray.origin;
            ray.tMax = 0.999f;
            break;
        default:
            ray.origin = random.inBox(low, high);
            ray.direction[int(random.below(3))] = random.unit() < 0.5f ? -1.0f : 1.0f;
            break;
        }
        rays.push_back(ray);
    }
    return rays;
}

// ------------------------------------------------------------------------------- the two tracers

constexpr std::string_view kShader = R"(#version 450
#include "shared/bindings.h"
#include "shared/bvh.h"

layout(local_size_x = 64) in;
layout(std140, binding = kPassBlock) uniform Params { BvhParams bvhParams; };
#include "lib/bvh_trace.glsl"

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
    BvhHit hit;
    closestHit(a.xyz, b.xyz, a.w, hit);
    bool anyHit = occluded(a.xyz, b.xyz, a.w);
    imageStore(hits, p, uvec4(floatBitsToUint(hit.t), hit.instance, hit.triangle, uint(anyHit)));
    imageStore(barycentrics, p, vec4(hit.barycentrics, 0.0, 0.0));
}
)";

enum class FetchBy { Default, Image, Sampler };

/// `rays` are a multiple of 512.
std::vector<Hit> traceWithGlsl(const SceneBvh& bvh, const std::vector<GpuRay>& rays,
                               FetchBy fetchBy = FetchBy::Default) {
    testContext();
    const ShaderLibrary& shaders = testShaders();
    Defines defines = shaders.common();
    if (fetchBy != FetchBy::Default)
        std::erase_if(defines, [](const auto& define) { return define.first == "FETCH_BY_IMAGE"; });
    if (fetchBy == FetchBy::Image)
        defines.emplace_back("FETCH_BY_IMAGE", "1");
    ComputeProgram program("bvh test", shaders.source().expandText("bvh test", kShader, defines));
    const auto uploaded = [](std::string_view label, const auto& values) {
        TexelBuffer buffer(label, values.size() * sizeof(values[0]));
        buffer.write(values);
        return buffer;
    };
    const TexelBuffer nodes = uploaded("nodes", bvh.nodes());
    const TexelBuffer triangles = uploaded("triangles", bvh.triangles());
    const TexelBuffer instances = uploaded("instances", bvh.instanceTexels());
    const TexelBuffer rayBuffer = uploaded("rays", rays);

    const glm::ivec2 size(512, int(rays.size() / 512));
    REQUIRE(std::size_t(size.x * size.y) == rays.size());
    GpuTexture hits("hits", PixelFormat::RGBA32UI, size);
    GpuTexture barycentrics("barycentrics", PixelFormat::RG32F, size);
    program.dispatch(size, bvh.params(),
                     {{"bvhNodes", nodes},
                      {"bvhTriangles", triangles},
                      {"bvhInstances", instances},
                      {"rays", rayBuffer}},
                     {{"hits", hits}, {"barycentrics", barycentrics}});

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

class EmbreeScene {
public:
    explicit EmbreeScene(const std::vector<WorldTriangle>& triangles)
        : triangles_(triangles), device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<glm::vec3*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    sizeof(glm::vec3), 3 * triangles.size()));
        auto* indices = static_cast<glm::uvec3*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    sizeof(glm::uvec3), triangles.size()));
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            std::copy_n(triangles[i].corners, 3, vertices + 3 * i);
            const auto v = std::uint32_t(3 * i);
            indices[i] = {v, v + 1, v + 2};
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        rtcCommitScene(scene_);
    }
    ~EmbreeScene() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    Hit trace(const GpuRay& ray) const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit query{};
        query.ray = {.org_x = ray.origin.x,
                     .org_y = ray.origin.y,
                     .org_z = ray.origin.z,
                     .tnear = 0.0f,
                     .dir_x = ray.direction.x,
                     .dir_y = ray.direction.y,
                     .dir_z = ray.direction.z,
                     .time = 0.0f,
                     .tfar = ray.tMax,
                     .mask = ~0u,
                     .id = 0,
                     .flags = 0};
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        RTCRay shadow = query.ray;
        rtcIntersect1(scene_, &context, &query);
        rtcOccluded1(scene_, &context, &shadow);
        Hit hit{.t = query.ray.tfar, .any = shadow.tfar < 0.0f};
        if (query.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
            hit.instance = triangles_[query.hit.primID].instance;
            hit.triangle = triangles_[query.hit.primID].triangle;
            hit.barycentrics = {query.hit.u, query.hit.v};
        }
        return hit;
    }

private:
    const std::vector<WorldTriangle>& triangles_;
    RTCDevice device_;
    RTCScene scene_;
};

// ----------------------------------------------------------------------------------------- ties

/// A ray and a triangle in double precision.
struct Exact {
    bool inside = false;            ///< the line of the ray meets the triangle
    double t = INFINITY;            ///< where it meets the triangle's plane
    double tolerance = 0.0;         ///< of t: what single precision may make of it
    double edgeDistance = INFINITY; ///< of the line from the nearest edge, metres
};

double lineToSegment(glm::dvec3 origin, glm::dvec3 direction, glm::dvec3 a, glm::dvec3 b) {
    // Across the ray, the segment is one in the plane and the line is the origin.
    const glm::dvec3 d = glm::normalize(direction);
    const glm::dvec3 p = (a - origin) - d * glm::dot(a - origin, d);
    const glm::dvec3 e = (b - a) - d * glm::dot(b - a, d);
    const double length2 = glm::dot(e, e);
    const double s = length2 > 0.0 ? std::clamp(-glm::dot(p, e) / length2, 0.0, 1.0) : 0.0;
    return glm::length(p + s * e);
}

Exact exactly(const GpuRay& ray, const WorldTriangle& triangle, double extent) {
    const glm::dvec3 o(ray.origin), d(ray.direction);
    const glm::dvec3 a(triangle.corners[0]), b(triangle.corners[1]), c(triangle.corners[2]);
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double slope = glm::dot(n, d);
    Exact exact;
    exact.edgeDistance =
        std::min({lineToSegment(o, d, a, b), lineToSegment(o, d, b, c), lineToSegment(o, d, c, a)});
    if (slope == 0.0)
        return exact;
    exact.t = glm::dot(n, a - o) / slope;
    const glm::dvec3 p = o + exact.t * d;
    const double u = glm::dot(glm::cross(c - b, p - b), n);
    const double v = glm::dot(glm::cross(a - c, p - c), n);
    const double w = glm::dot(glm::cross(b - a, p - a), n);
    exact.inside = u >= 0.0 && v >= 0.0 && w >= 0.0;
    // An error of a few ulps of the scene across the triangle becomes one along a grazing ray.
    const double cosine = std::abs(slope) / (glm::length(n) * glm::length(d));
    exact.tolerance = 4e-7 * extent / (glm::length(d) * cosine);
    return exact;
}

class Judge {
public:
    Judge(const std::vector<WorldTriangle>& triangles, std::size_t instances)
        : triangles_(triangles), first_(instances, 0) {
        glm::vec3 low(1e30f), high(-1e30f);
        for (std::size_t i = triangles.size(); i-- > 0;) {
            first_[triangles[i].instance] = i;
            low = glm::min(low, triangles[i].corners[0]);
            high = glm::max(high, triangles[i].corners[0]);
        }
        extent_ = glm::length(high - low);
        edge_ = 4e-7 * extent_;
    }

    double edge() const { return edge_; }

    /// How far a claimed hit is from where its triangle is, in tolerances of t.
    double error(const GpuRay& ray, const Hit& hit) const {
        const Exact exact = of(ray, hit);
        return std::abs(exact.t - double(hit.t)) / exact.tolerance;
    }

    /// Whether the claim is true: the triangle is hit, or the ray touches its edge, at that
    /// distance.
    bool holds(const GpuRay& ray, const Hit& hit) const {
        const Exact exact = of(ray, hit);
        return (exact.inside || exact.edgeDistance <= edge_) && error(ray, hit) <= 1.0;
    }

    /// Whether barycentrics and distance speak of one point. Those of a sliver are less certain: an
    /// error across it is one along it, longer by the ratio of its sides.
    bool consistent(const GpuRay& ray, const Hit& hit) const {
        const auto& c = triangleOf(hit).corners;
        const float w = 1.0f - hit.barycentrics.x - hit.barycentrics.y;
        const glm::vec3 p = w * c[0] + hit.barycentrics.x * c[1] + hit.barycentrics.y * c[2];
        const float longest = std::max(
            {glm::distance(c[0], c[1]), glm::distance(c[1], c[2]), glm::distance(c[2], c[0])});
        const double slenderness = double(longest) * double(longest) /
                                   double(glm::length(glm::cross(c[1] - c[0], c[2] - c[0])));
        const double tolerance =
            2.0 * of(ray, hit).tolerance * double(glm::length(ray.direction)) * (1.0 + slenderness);
        return double(glm::length(ray.origin + hit.t * ray.direction - p)) <= tolerance;
    }

    enum class Verdict {
        Wrong,
        Edge,      ///< the nearer of the two hits is at an edge or at an end of the ray
        Coincident ///< two triangles lie in one plane, and the ray goes through both
    };

    /// What two different answers come from.
    Verdict judge(const GpuRay& ray, const Hit& a, const Hit& b) const {
        if ((a.closest() && !holds(ray, a)) || (b.closest() && !holds(ray, b)))
            return Verdict::Wrong;
        const Hit& nearer = a.closest() && (!b.closest() || a.t < b.t) ? a : b;
        if (doubtful(ray, of(ray, nearer)))
            return Verdict::Edge;
        if (a.closest() && b.closest() &&
            std::abs(double(a.t) - double(b.t)) <= of(ray, a).tolerance + of(ray, b).tolerance)
            return Verdict::Coincident;
        return Verdict::Wrong;
    }

    /// Whether "anything" and "nothing" are both right: all there is to hit is hit at an edge or at
    /// an end of the ray, and there is such a thing.
    bool tieOfAny(const GpuRay& ray) const {
        bool some = false;
        for (const WorldTriangle& triangle : triangles_) {
            const Exact exact = exactly(ray, triangle, extent_);
            if (!(exact.inside || exact.edgeDistance <= edge_) || exact.t < -exact.tolerance ||
                exact.t > double(ray.tMax) + exact.tolerance)
                continue;
            if (!doubtful(ray, exact))
                return false;
            some = true;
        }
        return some;
    }

private:
    bool doubtful(const GpuRay& ray, const Exact& exact) const {
        return exact.edgeDistance <= edge_ || std::abs(exact.t) <= exact.tolerance ||
               std::abs(exact.t - double(ray.tMax)) <= exact.tolerance;
    }
    const WorldTriangle& triangleOf(const Hit& hit) const {
        return triangles_[first_[hit.instance] + hit.triangle];
    }
    Exact of(const GpuRay& ray, const Hit& hit) const {
        return exactly(ray, triangleOf(hit), extent_);
    }

    const std::vector<WorldTriangle>& triangles_;
    std::vector<std::size_t> first_; // of an instance
    double extent_ = 0.0, edge_ = 0.0;
};

constexpr std::size_t kRays = 512 * 256;

/// `mostCoincident`: of rays whose nearest hit is on two surfaces at once, which the scene decides.
void compareWithEmbree(const Scene& scene, const SceneBvh& bvh, const Pose& pose, Random& random,
                       int mostCoincident = 0) {
    const std::vector<WorldTriangle> triangles = worldTriangles(scene, pose);
    const std::vector<GpuRay> rays = raysAround(triangles, kRays, random);
    const std::vector<Hit> ours = traceWithGlsl(bvh, rays);
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
    REQUIRE(bvh.params().movingInstances == 40);
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
