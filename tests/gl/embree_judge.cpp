// SPDX-License-Identifier: MIT
#include "tests/gl/embree_judge.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <embree3/rtcore.h>

namespace afterglow::test {

/// A ray and a triangle in double precision.
struct Exact {
    bool inside = false;            ///< the line of the ray meets the triangle
    double t = INFINITY;            ///< where it meets the triangle's plane
    double tolerance = 0.0;         ///< of t: what single precision may make of it
    double edgeDistance = INFINITY; ///< of the line from the nearest edge, meters
};

namespace {

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

} // namespace

EmbreeScene::EmbreeScene(const std::vector<WorldTriangle>& triangles)
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

EmbreeScene::~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

Hit EmbreeScene::trace(const GpuRay& ray) const {
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

Judge::Judge(const std::vector<WorldTriangle>& triangles, std::size_t instances)
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

double Judge::error(const GpuRay& ray, const Hit& hit) const {
    const Exact exact = of(ray, hit);
    return std::abs(exact.t - double(hit.t)) / exact.tolerance;
}

bool Judge::holds(const GpuRay& ray, const Hit& hit) const {
    const Exact exact = of(ray, hit);
    return (exact.inside || exact.edgeDistance <= edge_) && error(ray, hit) <= 1.0;
}

bool Judge::consistent(const GpuRay& ray, const Hit& hit) const {
    const auto& c = triangleOf(hit).corners;
    const float w = 1.0f - hit.barycentrics.x - hit.barycentrics.y;
    const glm::vec3 p = w * c[0] + hit.barycentrics.x * c[1] + hit.barycentrics.y * c[2];
    const float longest =
        std::max({glm::distance(c[0], c[1]), glm::distance(c[1], c[2]), glm::distance(c[2], c[0])});
    const double slenderness = double(longest) * double(longest) /
                               double(glm::length(glm::cross(c[1] - c[0], c[2] - c[0])));
    const double tolerance =
        2.0 * of(ray, hit).tolerance * double(glm::length(ray.direction)) * (1.0 + slenderness);
    return double(glm::length(ray.origin + hit.t * ray.direction - p)) <= tolerance;
}

Judge::Verdict Judge::judge(const GpuRay& ray, const Hit& a, const Hit& b) const {
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

bool Judge::tieOfAny(const GpuRay& ray) const {
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

bool Judge::doubtful(const GpuRay& ray, const Exact& exact) const {
    return exact.edgeDistance <= edge_ || std::abs(exact.t) <= exact.tolerance ||
           std::abs(exact.t - double(ray.tMax)) <= exact.tolerance;
}

const WorldTriangle& Judge::triangleOf(const Hit& hit) const {
    return triangles_[first_[hit.instance] + hit.triangle];
}

Exact Judge::of(const GpuRay& ray, const Hit& hit) const {
    return exactly(ray, triangleOf(hit), extent_);
}

} // namespace afterglow::test
