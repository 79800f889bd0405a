// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "renderer/scene/scene.h"

// A scene at one moment, and a camera, in double precision: every triangle in the world, in a list.

namespace afterglow::reference {

struct Triangle {
    glm::dvec3 corners[3]; ///< world, meters
    glm::dvec3 front{0.0}; ///< world, unit: of the face, to its front; 0 if it has no area
    std::uint32_t instance = 0, triangle = 0;
    bool doubleSided = false;

    glm::dvec3 edge1() const { return corners[1] - corners[0]; }
    glm::dvec3 edge2() const { return corners[2] - corners[0]; }
    double area() const { return 0.5 * glm::length(glm::cross(edge1(), edge2())); }
    /// b: the weights of vertices 1 and 2.
    glm::dvec3 at(glm::dvec2 b) const { return corners[0] + b.x * edge1() + b.y * edge2(); }
};

inline glm::dvec3 unitOrZero(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec3(0.0);
}

/// Where a line meets the plane of a triangle.
struct PlaneHit {
    double t;     ///< in lengths of the direction
    glm::dvec2 b; ///< weights of vertices 1 and 2; anything outside the triangle
    double inside() const { return std::min({b.x, b.y, 1.0 - b.x - b.y}); } ///< >= 0: in it
};

/// Nothing for a line along the plane.
inline std::optional<PlaneHit> meetPlane(const Triangle& triangle, const glm::dvec3& origin,
                                         const glm::dvec3& direction) {
    const glm::dvec3 e1 = triangle.edge1(), e2 = triangle.edge2();
    const glm::dvec3 normal = glm::cross(e1, e2);
    const double along = glm::dot(normal, direction);
    if (along == 0.0)
        return {};
    const double t = glm::dot(normal, triangle.corners[0] - origin) / along;
    const glm::dvec3 offset = origin + t * direction - triangle.corners[0];
    const double square = glm::dot(normal, normal);
    return PlaneHit{t,
                    {glm::dot(normal, glm::cross(offset, e2)) / square,
                     glm::dot(normal, glm::cross(e1, offset)) / square}};
}

/// All triangles of a scene in the world.
struct SceneView {
    SceneView() = default;
    SceneView(const Scene& scene, double seconds) {
        const Pose pose = poseAt(scene, seconds);
        for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
            const Instance& instance = scene.instances[i];
            const Mesh& mesh = scene.meshes[instance.mesh];
            const glm::dmat4 world(pose.worldFromNode[instance.node]);
            const glm::dmat3 normalMatrix = glm::transpose(glm::inverse(glm::dmat3(world)));
            linear.push_back(glm::dmat3(world));
            normalMatrices.push_back(normalMatrix);
            firstOfInstance.push_back(triangles.size());
            for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
                Triangle out;
                out.instance = i;
                out.triangle = t;
                out.doubleSided = scene.materials[instance.material].doubleSided;
                glm::dvec3 own[3];
                for (int k = 0; k < 3; ++k) {
                    own[k] = glm::dvec3(mesh.positions[mesh.triangles[t][k]]);
                    out.corners[k] = glm::dvec3(world * glm::dvec4(own[k], 1.0));
                }
                // Counter-clockwise in its own space; a mirror turns the order of the corners,
                // not the front.
                out.front = unitOrZero(normalMatrix * glm::cross(own[1] - own[0], own[2] - own[0]));
                triangles.push_back(out);
            }
        }
    }

    const Triangle& at(std::uint32_t instance, std::uint32_t triangle) const {
        return triangles[firstOfInstance[instance] + triangle];
    }
    std::size_t instances() const { return firstOfInstance.size(); }

    /// The diagonal of the box around everything.
    double extent() const {
        if (triangles.empty())
            return 0.0;
        glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
        for (const Triangle& triangle : triangles)
            for (const glm::dvec3& corner : triangle.corners) {
                low = glm::min(low, corner);
                high = glm::max(high, corner);
            }
        return glm::length(high - low);
    }

    std::vector<Triangle> triangles; ///< by instance, then as in the mesh
    std::vector<std::size_t> firstOfInstance;
    std::vector<glm::dmat3> linear;         ///< parts of worldFromObject, by instance
    std::vector<glm::dmat3> normalMatrices; ///< inverse transposes, by instance
};

/// A pinhole camera and its picture.
struct View {
    View() = default;
    View(const Camera& camera, glm::ivec2 pixels)
        : eye(camera.position),
          worldFromView(glm::mat3_cast(glm::normalize(glm::dquat(camera.orientation)))),
          size(pixels), near(camera.lens.near), far(camera.lens.far) {
        const double tangent = std::tan(0.5 * double(camera.lens.verticalFov));
        tangents = {tangent * double(pixels.x) / double(pixels.y), tangent};
    }

    /// x to the right, y up, z towards the viewer.
    glm::dvec3 toView(const glm::dvec3& world) const {
        return glm::transpose(worldFromView) * (world - eye);
    }
    double depth(const glm::dvec3& world) const { return -toView(world).z; }

    /// Reversed depth: z = w at the near plane, 0 at the far one.
    glm::dvec4 clip(const glm::dvec3& world) const {
        const glm::dvec3 v = toView(world);
        const double w = -v.z;
        const double z = std::isinf(far) ? near : near * (far - w) / (far - near);
        return {v.x / tangents.x, v.y / tangents.y, z, w};
    }
    /// Row 0 is the top. The point must be in front of the camera.
    glm::dvec2 pixel(const glm::dvec3& world) const {
        const glm::dvec4 c = clip(world);
        return {(0.5 + 0.5 * c.x / c.w) * size.x, (0.5 - 0.5 * c.y / c.w) * size.y};
    }
    /// The direction of the points at a place in the picture, as long as to get one meter deeper.
    glm::dvec3 ray(const glm::dvec2& place) const {
        return worldFromView * glm::dvec3((2.0 * place.x / size.x - 1.0) * tangents.x,
                                          (1.0 - 2.0 * place.y / size.y) * tangents.y, -1.0);
    }

    glm::dvec3 eye{0.0};
    glm::dmat3 worldFromView{1.0};
    glm::ivec2 size{1};
    glm::dvec2 tangents{1.0}; ///< of half the field of view, across and up
    double near = 0.0, far = 0.0;
};

struct Seen {
    const Triangle* triangle = nullptr; ///< none: background
    PlaneHit hit{};
};

/// What the camera sees at a place of the picture: the nearest triangle that shows it its front, or
/// either side if it has two. Every triangle in turn.
inline Seen look(const SceneView& scene, const View& view, const glm::dvec2& place) {
    const glm::dvec3 direction = view.ray(place);
    Seen nearest;
    double limit = view.far;
    for (const Triangle& triangle : scene.triangles) {
        if (!triangle.doubleSided && glm::dot(triangle.front, direction) >= 0.0)
            continue;
        const auto hit = meetPlane(triangle, view.eye, direction);
        if (!hit || hit->t < view.near || hit->t > limit || !(hit->inside() >= 0.0))
            continue;
        nearest = {&triangle, *hit};
        limit = hit->t;
    }
    return nearest;
}

/// The distance in the picture, in pixels, from a place to the outline of a triangle.
inline double pixelsToOutline(const Triangle& triangle, const View& view, const glm::dvec2& place) {
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
        glm::dvec3 a = triangle.corners[k], b = triangle.corners[(k + 1) % 3];
        const double za = view.depth(a), zb = view.depth(b);
        if (za < view.near && zb < view.near)
            continue;
        if (za < view.near)
            a = glm::mix(a, b, (view.near - za) / (zb - za));
        else if (zb < view.near)
            b = glm::mix(b, a, (view.near - zb) / (za - zb));
        const glm::dvec2 pa = view.pixel(a), pb = view.pixel(b);
        const glm::dvec2 edge = pb - pa;
        const double square = glm::dot(edge, edge);
        const double t =
            square > 0.0 ? std::clamp(glm::dot(place - pa, edge) / square, 0.0, 1.0) : 0.0;
        least = std::min(least, glm::length(place - pa - t * edge));
    }
    return least;
}

} // namespace afterglow::reference
