// SPDX-License-Identifier: MIT
#include "tests/support/bvh_trace.h"

#include <algorithm>
#include <cmath>

namespace afterglow::test {

namespace {

/// A direction component is at least this, so that its inverse is finite and 0 * infinity, which is
/// not a number, cannot come up.
constexpr double kSmallestDirection = 1e-150;

/// Signed volumes on the three edges; see shaders/lib/bvh_trace.glsl.
std::optional<RayHit> intersect(const gpu::BvhTriangle& triangle, const Ray& ray) {
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
    if (slope == 0.0 || !(t > 0.0 && t < ray.tMax))
        return std::nullopt;
    return RayHit{.t = t,
                  .instance = triangle.instance & gpu::kBvhInstanceMask,
                  .triangle = triangle.triangle,
                  .barycentrics = glm::dvec2(u, v) / (u + v + w)};
}

class Tracer {
public:
    Tracer(const SceneBvh& bvh, const Ray& ray, bool any)
        : records_(bvh.records()), ray_(ray), any_(any) {
        for (int axis = 0; axis < 3; ++axis)
            inverse_[axis] = 1.0 / (std::abs(ray.direction[axis]) < kSmallestDirection
                                        ? std::copysign(kSmallestDirection, ray.direction[axis])
                                        : ray.direction[axis]);
    }

    std::optional<RayHit> trace() {
        visit(gpu::kBvhRoot);
        return best_;
    }

private:
    bool meets(const Aabb& box) const {
        const glm::dvec3 a = (glm::dvec3(box.min) - ray_.origin) * inverse_;
        const glm::dvec3 b = (glm::dvec3(box.max) - ray_.origin) * inverse_;
        const glm::dvec3 low = glm::min(a, b), high = glm::max(a, b);
        const double near = std::max({low.x, low.y, low.z, 0.0});
        return near <= std::min({high.x, high.y, high.z, ray_.tMax}) * (1.0 + 1e-14);
    }

    void visit(std::uint32_t index) {
        const BvhRecord& record = records_[index];
        if (record.isTriangle()) {
            if (const auto hit = intersect(record.triangle(), ray_)) {
                best_ = hit;
                ray_.tMax = hit->t;
            }
            if (record.triangle().next != 0)
                visit(record.triangle().next);
            return;
        }
        const gpu::BvhNode node = record.node();
        for (std::uint32_t k = 0; k < gpu::kBvhWidth && !(any_ && best_); ++k) {
            const Aabb box = childBox(node, k);
            if (!box.empty() && meets(box))
                visit(gpu::kBvhWidth * node.block + k);
        }
    }

    std::span<const BvhRecord> records_;
    Ray ray_;
    glm::dvec3 inverse_;
    bool any_;
    std::optional<RayHit> best_;
};

} // namespace

std::optional<RayHit> closestHit(const SceneBvh& bvh, const Ray& ray) {
    return Tracer(bvh, ray, false).trace();
}

bool occluded(const SceneBvh& bvh, const Ray& ray) {
    return Tracer(bvh, ray, true).trace().has_value();
}

} // namespace afterglow::test
