// SPDX-License-Identifier: MIT
#include "tests/support/bvh_trace.h"
#include "tests/unit/random_points.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>
#include <glm/gtc/matrix_transform.hpp>

using namespace afterglow;
using namespace afterglow::test;

namespace {

void addTriangle(Mesh& mesh, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    const auto first = std::uint32_t(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c});
    mesh.normals.insert(mesh.normals.end(), 3, glm::vec3(0.0f, 1.0f, 0.0f));
    mesh.triangles.emplace_back(first, first + 1, first + 2);
}

Scene sceneOf(Mesh mesh) {
    Scene scene;
    scene.meshes.push_back(std::move(mesh));
    scene.materials.emplace_back();
    scene.nodes.emplace_back();
    scene.instances.push_back({.mesh = 0, .material = 0, .node = 0});
    return scene;
}

void addInstance(Scene& scene, std::uint32_t mesh, const Node& node, bool moving) {
    const auto index = std::uint32_t(scene.nodes.size());
    scene.nodes.push_back(node);
    scene.instances.push_back({.mesh = mesh, .material = 0, .node = index});
    if (moving)
        scene.tracks.push_back(
            {.node = index,
             .path = Track::Path::Translation,
             .interpolation = Track::Interpolation::Linear,
             .times = {0.0, 1.0},
             .values = {glm::vec4(node.translation, 0.0f), glm::vec4(-node.translation, 0.0f)}});
}

/// Triangles of a size anywhere in a cube.
Mesh soup(Random& random, int count, double half, double size) {
    Mesh mesh;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 center = random.inCube(half);
        addTriangle(mesh, center + random.inCube(size), center + random.inCube(size),
                    center + random.inCube(size));
    }
    return mesh;
}

/// A floor of unit squares with whole-numbered corners: every box is flat.
Mesh grid(int cells) {
    Mesh mesh;
    for (int z = 0; z < cells; ++z)
        for (int x = 0; x < cells; ++x) {
            addTriangle(mesh, {x, 0, z}, {x, 0, z + 1}, {x + 1, 0, z + 1});
            addTriangle(mesh, {x, 0, z}, {x + 1, 0, z + 1}, {x + 1, 0, z});
        }
    return mesh;
}

struct Triangle {
    std::uint32_t instance, triangle;
    glm::dvec3 corners[3];
};

/// Every triangle where it stands, rounded once, as SceneBvh documents.
std::vector<Triangle> trianglesOf(const Scene& scene, const Pose& pose) {
    std::vector<Triangle> all;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const glm::dmat4 matrix(pose.worldFromNode[instance.node]);
        const Mesh& mesh = scene.meshes[instance.mesh];
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            Triangle triangle{.instance = i, .triangle = t, .corners = {}};
            for (int c = 0; c < 3; ++c) {
                const glm::dvec4 local(mesh.positions[mesh.triangles[t][c]], 1.0);
                triangle.corners[c] = glm::dvec3(glm::vec3(matrix * local));
            }
            all.push_back(triangle);
        }
    }
    return all;
}

/// Moeller and Trumbore, "Fast, Minimum Storage Ray-Triangle Intersection", 1997.
std::optional<RayHit> intersect(const Triangle& triangle, const Ray& ray) {
    const glm::dvec3 a = triangle.corners[1] - triangle.corners[0];
    const glm::dvec3 b = triangle.corners[2] - triangle.corners[0];
    const glm::dvec3 p = glm::cross(ray.direction, b);
    const double determinant = glm::dot(a, p);
    if (determinant == 0.0)
        return std::nullopt;
    const glm::dvec3 s = ray.origin - triangle.corners[0];
    const glm::dvec3 q = glm::cross(s, a);
    const double u = glm::dot(s, p) / determinant;
    const double v = glm::dot(ray.direction, q) / determinant;
    const double t = glm::dot(b, q) / determinant;
    if (u < 0.0 || v < 0.0 || u + v > 1.0 || !(t > 0.0 && t < ray.tMax))
        return std::nullopt;
    return RayHit{t, triangle.instance, triangle.triangle, {u, v}};
}

bool same(double a, double b) {
    return std::abs(a - b) <= 1e-7 * std::max(std::abs(a), std::abs(b));
}

/// Whether the tree says of a ray what all triangles in turn say. Among triangles at one distance
/// (they may be identical) the tree may name any.
bool agrees(const SceneBvh& bvh, const std::vector<Triangle>& triangles, const Ray& ray) {
    double nearest = ray.tMax;
    bool any = false;
    for (const Triangle& triangle : triangles)
        if (const auto hit = intersect(triangle, ray)) {
            any = true;
            nearest = std::min(nearest, hit->t);
        }
    const auto found = closestHit(bvh, ray);
    if (found.has_value() != any || occluded(bvh, ray) != any)
        return false;
    if (!any)
        return true;
    for (const Triangle& triangle : triangles)
        if (triangle.instance == found->instance && triangle.triangle == found->triangle) {
            const auto hit = intersect(triangle, ray);
            return hit && same(hit->t, found->t) && same(found->t, nearest) &&
                   glm::length(hit->barycentrics - found->barycentrics) < 1e-6;
        }
    return false;
}

struct Tally {
    int rays = 0, hits = 0, wrong = 0;
};

/// Rays of every kind around a scene whose coordinates are within `half` of the origin.
Tally compare(const Scene& scene, const SceneBvh& bvh, const Pose& pose, double half, int rays,
              Random& random) {
    const std::vector<Triangle> triangles = trianglesOf(scene, pose);
    Tally tally;
    for (int i = 0; i < rays; ++i) {
        Ray ray;
        ray.origin = random.inCube(1.5 * half);
        switch (i % 4) {
        case 0: // anywhere
            ray.direction = random.inCube(1.0);
            break;
        case 1: // a segment between two points, as a shadow ray
            ray.direction = random.inCube(half) - ray.origin;
            ray.tMax = 1.0;
            break;
        case 2: // along an axis: two components are zero
            ray.direction = glm::dvec3(0.0);
            ray.direction[random.below(3)] = random.unit() < 0.5 ? -half : half;
            break;
        default: // towards a point in a triangle, so that there is something to hit
            if (!triangles.empty()) {
                const Triangle& goal = triangles[std::size_t(random.below(int(triangles.size())))];
                ray.direction = 0.5 * goal.corners[0] + 0.2 * goal.corners[1] +
                                0.3 * goal.corners[2] - ray.origin;
            }
            break;
        }
        ++tally.rays;
        tally.hits += closestHit(bvh, ray).has_value();
        tally.wrong += !agrees(bvh, triangles, ray);
    }
    return tally;
}

} // namespace

TEST_CASE("a tree finds what all triangles in turn find") {
    Random random(5);
    for (const int count : {0, 1, 2, 3, 4, 5, 9, 40, 300})
        for (const double scale : {1e-6, 1.0, 1e6})
            for (const double size : {0.02, 0.3, 2.0}) {
                CAPTURE(count);
                CAPTURE(scale);
                CAPTURE(size);
                const Scene scene = sceneOf(soup(random, count, scale, size * scale));
                const SceneBvh bvh(scene);
                const Tally tally = compare(scene, bvh, poseAt(scene, 0.0), scale, 400, random);
                CHECK(tally.wrong == 0);
                if (count > 0)
                    CHECK(tally.hits >= tally.rays / 5);
            }
}

TEST_CASE("flat boxes hide what is behind them, from every side and along their edges") {
    const Scene scene = sceneOf(grid(9));
    const SceneBvh bvh(scene);
    const std::vector<Triangle> triangles = trianglesOf(scene, poseAt(scene, 0.0));
    int hits = 0;
    for (int x = -2; x <= 22; ++x)
        for (int z = -2; z <= 22; ++z) // through corners, edges and middles: exact in binary
            for (const double y : {3.0, -3.0}) {
                const Ray down{.origin = {0.5 * x, y, 0.5 * z}, .direction = {0.0, -y, 0.0}};
                const Ray slanted{.origin = {0.5 * x, y, 0.5 * z}, .direction = {0.5, -y, 0.25}};
                CHECK(agrees(bvh, triangles, down));
                CHECK(agrees(bvh, triangles, slanted));
                hits += occluded(bvh, down);
            }
    CHECK(hits == 2 * 19 * 19); // 0 to 9 in steps of a half, borders included
    CHECK_FALSE(occluded(bvh, {.origin = {-1.0, 0.0, 4.5}, .direction = {1.0, 0.0, 0.0}}));
}

TEST_CASE("identical and degenerate triangles do no harm") {
    Mesh mesh;
    for (int i = 0; i < 5000; ++i)
        addTriangle(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    for (int i = 0; i < 500; ++i) {
        addTriangle(mesh, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}); // a point
        addTriangle(mesh, {0, 0, 1}, {1, 1, 1}, {2, 2, 1}); // a line
    }
    const Scene scene = sceneOf(mesh);
    const SceneBvh bvh(scene);
    Random random(3);
    const Tally tally = compare(scene, bvh, poseAt(scene, 0.0), 1.0, 200, random);
    CHECK(tally.wrong == 0);
    CHECK(tally.hits > 30);
}

TEST_CASE(
    "moving instances are hit where they are, however they are turned, squeezed and mirrored") {
    Random random(17);
    for (int round = 0; round < 12; ++round) {
        Scene scene = sceneOf(soup(random, 60, 2.0, 0.5));
        scene.meshes.push_back(soup(random, 50, 0.5, 0.3));
        scene.meshes.push_back(soup(random, 1, 0.5, 0.5));
        const int movers = round; // the first round has none
        for (int i = 0; i < movers; ++i) {
            Node node;
            node.translation = glm::vec3(random.inCube(1.5));
            node.rotation = glm::normalize(
                glm::quat(float(random.between(-1, 1)), glm::vec3(random.inCube(1.0))));
            const double mirrored = i % 2 == 0 ? 1.0 : -1.0;
            node.scale = glm::vec3(mirrored * random.between(0.2, 2.0), random.between(0.2, 2.0),
                                   random.between(0.05, 1.0));
            if (i % 3 == 2)
                node.parent = int(scene.nodes.size()) - 1; // sheared by its parent
            addInstance(scene, std::uint32_t(1 + i % 2), node, i % 4 != 3);
        }
        SceneBvh bvh(scene);
        CHECK((bvh.movingInstances() > 0) == (movers > 0));
        for (const double seconds : {0.0, 0.37, 1.0}) {
            CAPTURE(round);
            CAPTURE(seconds);
            const Pose pose = poseAt(scene, seconds);
            bvh.refresh(pose);
            const Tally tally = compare(scene, bvh, pose, 2.0, 300, random);
            CHECK(tally.wrong == 0);
            CHECK(tally.hits > 60);
        }
    }
}

TEST_CASE("a refresh changes nothing where nothing moves") {
    Random random(2);
    const Scene scene = sceneOf(soup(random, 20, 1.0, 0.5));
    SceneBvh bvh(scene);
    bvh.refresh(poseAt(scene, 0.5));
    CHECK(bvh.changed().empty());
    CHECK(SceneBvh(Scene{}).records().size() >= gpu::kBvhWidth);
}

TEST_CASE("a refresh keeps all sizes, and tells which records it has changed") {
    Random random(8);
    Scene scene = sceneOf(soup(random, 20, 1.0, 0.5));
    scene.meshes.push_back(soup(random, 33, 1.0, 0.5));
    Node node;
    node.translation = {0.0f, 5.0f, 0.0f};
    addInstance(scene, 1, node, true);
    node.translation = {0.0f, 9.0f, 0.0f};
    addInstance(scene, 1, node, true);
    SceneBvh bvh(scene);
    CHECK(bvh.movingInstances() == 2);
    const auto copy = [&] {
        return LargeArray<BvhRecord>(bvh.records().begin(), bvh.records().end());
    };
    const LargeArray<BvhRecord> before = copy();
    for (const double seconds : {0.5, 0.5, 0.0}) {
        const LargeArray<BvhRecord> last = copy();
        bvh.refresh(poseAt(scene, seconds));
        REQUIRE(bvh.records().size() == before.size());
        LargeArray<BvhRecord> uploaded = last;
        for (const SceneBvh::Span span : bvh.changed())
            std::copy_n(bvh.records().begin() + std::ptrdiff_t(span.first), span.count,
                        uploaded.begin() + std::ptrdiff_t(span.first));
        CHECK(uploaded == copy());
        CHECK(bvh.changed().empty() == (last == copy()));
    }
    CHECK(copy() == before);
}

TEST_CASE("a moving instance that is squeezed to nothing is not hit, and the others are") {
    Scene scene = sceneOf({});
    scene.meshes.push_back(grid(2));
    Node flat;
    flat.scale = {0.0f, 1.0f, 1.0f};
    addInstance(scene, 1, flat, true);
    Node whole;
    whole.translation = {10.0f, 0.0f, 0.0f};
    addInstance(scene, 1, whole, true);
    const SceneBvh bvh(scene);
    CHECK_FALSE(occluded(bvh, {.origin = {0.0, 1.0, 0.5}, .direction = {0.0, -1.0, 0.0}}));
    const auto hit = closestHit(bvh, {.origin = {11.2, 1.0, 0.5}, .direction = {0.0, -2.0, 0.0}});
    REQUIRE(hit);
    CHECK(hit->instance == 2);
    CHECK(hit->t == doctest::Approx(0.5));
}

TEST_CASE("a ray begins after its origin and ends before tMax") {
    Mesh mesh;
    addTriangle(mesh, {-1, -1, 0}, {3, -1, 0}, {-1, 3, 0});
    const SceneBvh bvh(sceneOf(mesh));
    const Ray ray{.origin = {0.0, 0.0, 2.0}, .direction = {0.0, 0.0, -2.0}, .tMax = 1.0};
    CHECK_FALSE(occluded(bvh, ray)); // the triangle is at t = 1, which is outside
    CHECK(occluded(bvh, {ray.origin, ray.direction, 1.0000001}));
    CHECK_FALSE(occluded(bvh, {{0.0, 0.0, 0.0}, ray.direction, 10.0})); // from the triangle itself
    CHECK_FALSE(occluded(bvh, {ray.origin, -ray.direction, 10.0}));
}
