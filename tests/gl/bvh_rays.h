// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <glm/gtc/constants.hpp>

#include "renderer/scene/scene.h"
#include "shared/bvh.h"

namespace afterglow::test {

// The scenes and rays with which the GLSL walk is tested against Embree.

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

/// Adds the parallelogram corner + [0, 1] a + [0, 1] b, as cells x cells x 2 triangles.
void addSquare(Mesh& mesh, glm::vec3 corner, glm::vec3 a, glm::vec3 b, int cells);

/// Adds a node and gives its index.
std::uint32_t addNode(Scene& scene, const Node& node);

/// One instance of the mesh, where it is.
Scene sceneOf(Mesh mesh);

/// A hall of 24 by 6 by 12 meters with columns, spheres and splinters: more than 100,000 triangles.
Mesh clutteredHall(Random& random);

/// A floor and forty things above it that move: turned, squeezed, half of them mirrored.
Scene movingThings(Random& random);

struct GpuRay { // two texels
    glm::vec3 origin;
    float tMax;
    glm::vec3 direction;
    std::uint32_t pad = 0;
};

struct Hit {
    float t = 0.0f;
    std::uint32_t instance = gpu::kBvhNoInstance, triangle = 0;
    glm::vec2 barycentrics{0.0f};
    bool any = false; ///< what the any-hit query says
    bool closest() const { return instance != gpu::kBvhNoInstance; }
    bool operator==(const Hit&) const = default;
};

struct WorldTriangle {
    std::uint32_t instance, triangle;
    glm::vec3 corners[3];
};

/// The scene as it stands, as triangles of the world, rounded once.
std::vector<WorldTriangle> worldTriangles(const Scene& scene, const Pose& pose);

/// Equal parts of bounce rays, short occlusion rays, shadow segments and rays along the axes.
std::vector<GpuRay> raysAround(const std::vector<WorldTriangle>& triangles, std::size_t count,
                               Random& random);

} // namespace afterglow::test
