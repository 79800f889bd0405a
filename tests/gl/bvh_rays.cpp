// SPDX-License-Identifier: MIT
#include "tests/gl/bvh_rays.h"

#include <utility>

namespace afterglow::test {

namespace {

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

} // namespace

void addSquare(Mesh& mesh, glm::vec3 corner, glm::vec3 a, glm::vec3 b, int cells) {
    addNet(mesh, cells, cells, [&](float u, float v) { return corner + u * a + v * b; });
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

} // namespace afterglow::test
