// SPDX-License-Identifier: MIT
#pragma once

#include "tests/reference/bsdf.h"
#include "tests/reference/lighting.h"

// The hits of a path's rays and the surfaces there: docs/pipeline.md, "Paths" and "Rays".

namespace afterglow::reference {

/// A surface at one end of a path; normals are of unit length.
struct PathSurface {
    LitSurface lit;
    MaterialFactors material;
    glm::dvec3 eye{0.0}; ///< what it is seen from
};

inline MaterialFactors factorsOf(const Material& material) {
    return {glm::dvec3(material.baseColor), material.metallic, material.roughness};
}

/// The surface at a place on a triangle, turned to where it is seen from. `b`: weights of vertices
/// 1 and 2.
inline PathSurface surfaceOn(const Scene& source, const SceneView& scene, const Triangle& triangle,
                             const glm::dvec2& b, const glm::dvec3& eye) {
    const Instance& instance = source.instances[triangle.instance];
    const Mesh& mesh = source.meshes[instance.mesh];
    const glm::uvec3 vertices = mesh.triangles[triangle.triangle];
    PathSurface out;
    out.eye = eye;
    out.lit.position = triangle.at(b);
    const bool isFront = glm::dot(triangle.front, eye - out.lit.position) >= 0.0;
    out.lit.geometric = isFront ? triangle.front : -triangle.front;
    const glm::dvec3 own = (1.0 - b.x - b.y) * glm::dvec3(mesh.normals[vertices.x]) +
                           b.x * glm::dvec3(mesh.normals[vertices.y]) +
                           b.y * glm::dvec3(mesh.normals[vertices.z]);
    out.lit.shading = glm::normalize(scene.normalMatrices[triangle.instance] * own);
    if (glm::dot(out.lit.shading, out.lit.geometric) < 0.0)
        out.lit.shading = -out.lit.shading;
    out.lit.worldFromObject = scene.linear[triangle.instance];
    out.material = factorsOf(source.materials[instance.material]);
    return out;
}

struct RayHit {
    const Triangle* triangle = nullptr; ///< none: the surroundings
    PlaneHit hit{};
};

/// The first triangle along l from o, from either side. Every triangle in turn.
inline RayHit closestHit(const SceneView& scene, const glm::dvec3& o, const glm::dvec3& l) {
    RayHit closest;
    for (const Triangle& triangle : scene.triangles) {
        const auto hit = meetPlane(triangle, o, l);
        if (hit && hit->t > 0.0 && hit->inside() >= 0.0 &&
            (!closest.triangle || hit->t < closest.hit.t))
            closest = {&triangle, *hit};
    }
    return closest;
}

/// Returns whether a small shift of the ray may change its hit: it passes an edge
/// within `margin`, meets its triangle edge-on, or meets another one at nearly the same place.
inline bool nearlyAnotherHit(const SceneView& scene, const glm::dvec3& o, const glm::dvec3& l,
                             const RayHit& closest, double margin) {
    double length = closest.hit.t;
    if (!closest.triangle)
        for (const Triangle& triangle : scene.triangles)
            for (const glm::dvec3& corner : triangle.corners)
                length = std::max(length, glm::length(corner - o) + margin);
    else if (std::abs(glm::dot(closest.triangle->front, l)) < 1e-3)
        return true;
    for (const Triangle& triangle : scene.triangles) {
        for (int k = 0; k < 3; ++k)
            if (distanceOfSegments(o, length * l, triangle.corners[k],
                                   triangle.corners[(k + 1) % 3] - triangle.corners[k]) < margin)
                return true;
        const auto hit = meetPlane(triangle, o, l);
        if (hit && &triangle != closest.triangle && hit->inside() >= 0.0 &&
            (std::abs(hit->t) < 0.01 * margin ||
             (closest.triangle && std::abs(hit->t - length) < margin)))
            return true;
    }
    return false;
}

} // namespace afterglow::reference
