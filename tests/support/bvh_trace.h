// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/bvh/scene_bvh.h"

#include <cstdint>
#include <limits>
#include <optional>

#include <glm/glm.hpp>

namespace afterglow::test {

/// The points origin + t * direction for t in (0, tMax). The direction need not have unit length.
struct Ray {
    glm::dvec3 origin{0.0}; ///< meters, world
    glm::dvec3 direction{0.0, 0.0, -1.0};
    double tMax = std::numeric_limits<double>::infinity();
};

struct RayHit {
    double t = 0.0;
    std::uint32_t instance = 0;   ///< index into Scene::instances
    std::uint32_t triangle = 0;   ///< index into Mesh::triangles
    glm::dvec2 barycentrics{0.0}; ///< weights of corners 1 and 2; corner 0 has the rest of one
};

/// Returns the nearest triangle, from either side: a walk over the records that shaders walk, in
/// double precision and as plain as can be.
std::optional<RayHit> closestHit(const SceneBvh& bvh, const Ray& ray);

/// Returns whether anything is hit.
bool occluded(const SceneBvh& bvh, const Ray& ray);

} // namespace afterglow::test
