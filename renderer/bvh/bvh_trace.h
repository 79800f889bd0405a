// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/bvh/scene_bvh.h"

#include <cstdint>
#include <limits>
#include <optional>

#include <glm/glm.hpp>

namespace afterglow {

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

/// The nearest triangle, from either side, in double precision. For picking and for references.
std::optional<RayHit> closestHit(const SceneBvh& bvh, const Ray& ray);

/// Whether anything is hit.
bool occluded(const SceneBvh& bvh, const Ray& ray);

} // namespace afterglow
