// SPDX-License-Identifier: MIT
#include "renderer/bvh/bvh_trace.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace afterglow {

namespace {

/// A direction component is at least this, so that its inverse is finite and 0 * infinity, which is
/// not a number, cannot come up.
constexpr double kSmallestDirection = 1e-150;

/// Widens the far end of a slab interval by more than its rounding. Ize, "Robust BVH Ray
/// Traversal", JCGT 2(2), 2013.
constexpr double kFarRounding = 1.0 + 1e-14;

struct PreparedRay {
    PreparedRay(glm::dvec3 rayOrigin, glm::dvec3 rayDirection)
        : origin(rayOrigin), direction(rayDirection) {
        for (int axis = 0; axis < 3; ++axis)
            inverse[axis] = 1.0 / (std::abs(direction[axis]) < kSmallestDirection
                                       ? std::copysign(kSmallestDirection, direction[axis])
                                       : direction[axis]);
    }

    glm::dvec3 origin, direction, inverse;
};

struct Interval {
    double near, far;
    bool empty() const { return !(near <= far); }
};

Interval clip(const PreparedRay& ray, glm::vec4 xy, float minZ, float maxZ, double tMax) {
    const glm::dvec3 a = (glm::dvec3(xy.x, xy.z, minZ) - ray.origin) * ray.inverse;
    const glm::dvec3 b = (glm::dvec3(xy.y, xy.w, maxZ) - ray.origin) * ray.inverse;
    const glm::dvec3 low = glm::min(a, b), high = glm::max(a, b);
    return {std::max(std::max(low.x, low.y), std::max(low.z, 0.0)),
            std::min(std::min(high.x, high.y), std::min(high.z, tMax)) * kFarRounding};
}

/// Calls leaf(first, count) for the leaves that the ray may meet before tMax, nearer ones first,
/// until it returns true. leaf may make tMax smaller.
template <class Leaf>
bool walk(std::span<const gpu::BvhNode> nodes, std::uint32_t root, const PreparedRay& ray,
          const double& tMax, const Leaf& leaf) {
    std::array<std::uint32_t, gpu::kBvhMaxDepth + 1> stack;
    std::size_t deferred = 0;
    stack[deferred++] = gpu::kBvhNone;
    std::uint32_t link = root;
    while (link != gpu::kBvhNone) {
        if (isLeaf(link)) {
            if (leaf(leafFirst(link), leafCount(link)))
                return true;
            link = stack[--deferred];
            continue;
        }
        const gpu::BvhNode& node = nodes[link];
        const Interval in0 = clip(ray, node.child0xy, node.childrenZ.x, node.childrenZ.y, tMax);
        const Interval in1 = clip(ray, node.child1xy, node.childrenZ.z, node.childrenZ.w, tMax);
        if (in0.empty() && in1.empty()) {
            link = stack[--deferred];
        } else if (in0.empty() || in1.empty()) {
            link = in0.empty() ? node.link1 : node.link0;
        } else {
            const bool swap = in1.near < in0.near;
            stack[deferred++] = swap ? node.link0 : node.link1;
            link = swap ? node.link1 : node.link0;
        }
    }
    return false;
}

/// Signed volumes on the three edges. Both triangles of a shared edge find the same number for it,
/// negated, so no ray slips between them. Davidovic et al., "3D Rasterization: A Bridge between
/// Rasterization and Ray Casting", GI 2012, in the form that Embree documents as robust.
std::optional<RayHit> intersect(const gpu::BvhTriangle& triangle, const PreparedRay& ray,
                                double tMax) {
    const glm::dvec3 v0 = glm::dvec3(triangle.v0) - ray.origin;
    const glm::dvec3 v1 = glm::dvec3(triangle.v1) - ray.origin;
    const glm::dvec3 v2 = glm::dvec3(triangle.v2) - ray.origin;
    const glm::dvec3 e0 = v2 - v0, e1 = v0 - v1, e2 = v1 - v2;
    const double u = glm::dot(glm::cross(e0, v2 + v0), ray.direction);
    const double v = glm::dot(glm::cross(e1, v0 + v1), ray.direction);
    const double w = glm::dot(glm::cross(e2, v1 + v2), ray.direction);
    if (std::min({u, v, w}) < 0.0 && std::max({u, v, w}) > 0.0)
        return std::nullopt;
    const glm::dvec3 normal = glm::cross(e0, e1);
    const double slope = glm::dot(normal, ray.direction);
    const double t = glm::dot(normal, v0) / slope;
    if (slope == 0.0 || !(t > 0.0 && t < tMax))
        return std::nullopt;
    return RayHit{.t = t,
                  .instance = triangle.instance,
                  .triangle = triangle.triangle,
                  .barycentrics = glm::dvec2(u, v) / (u + v + w)};
}

class Tracer {
public:
    Tracer(const SceneBvh& bvh, double tMax, bool any) : bvh_(bvh), tMax_(tMax), any_(any) {}

    std::optional<RayHit> trace(const Ray& ray) {
        const PreparedRay world(ray.origin, ray.direction);
        if (tree(0, world, gpu::kBvhNone) || bvh_.params().movingInstances == 0)
            return best_;
        walk(bvh_.top().nodes, 0, world, tMax_, [&](std::uint32_t first, std::uint32_t count) {
            for (std::uint32_t i = first; i < first + count; ++i) {
                const SceneBvh::Moving& moving = bvh_.moving()[bvh_.top().order[i]];
                const PreparedRay local(moving.objectFromWorld * glm::dvec4(ray.origin, 1.0),
                                        moving.objectFromWorld * glm::dvec4(ray.direction, 0.0));
                if (tree(moving.root, local, moving.instance))
                    return true;
            }
            return false;
        });
        return best_;
    }

private:
    /// Walks one tree of triangles; whether the answer is known.
    bool tree(std::uint32_t root, const PreparedRay& ray, std::uint32_t instance) {
        return walk(bvh_.nodes(), root, ray, tMax_, [&](std::uint32_t first, std::uint32_t count) {
            for (std::uint32_t i = first; i < first + count; ++i)
                if (auto hit = intersect(bvh_.triangles()[i], ray, tMax_)) {
                    hit->instance = std::min(hit->instance, instance); // one of them is "none"
                    best_ = hit;
                    tMax_ = hit->t;
                    if (any_)
                        return true;
                }
            return false;
        });
    }

    const SceneBvh& bvh_;
    double tMax_;
    bool any_;
    std::optional<RayHit> best_;
};

} // namespace

std::optional<RayHit> closestHit(const SceneBvh& bvh, const Ray& ray) {
    return Tracer(bvh, ray.tMax, false).trace(ray);
}

bool occluded(const SceneBvh& bvh, const Ray& ray) {
    return Tracer(bvh, ray.tMax, true).trace(ray).has_value();
}

} // namespace afterglow
