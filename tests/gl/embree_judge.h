// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "tests/gl/bvh_rays.h"

struct RTCDeviceTy; // Embree's: only embree_judge.cpp sees the library
struct RTCSceneTy;

namespace afterglow::test {

/// Embree's answers, in its robust mode, on one thread. The triangles must outlive it.
class EmbreeScene {
public:
    explicit EmbreeScene(const std::vector<WorldTriangle>& triangles);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    Hit trace(const GpuRay& ray) const;

private:
    const std::vector<WorldTriangle>& triangles_;
    RTCDeviceTy* device_;
    RTCSceneTy* scene_;
};

struct Exact;

/// Says in double precision whether two tracers that differ may both be right: for rays that touch
/// an edge or meet two triangles at one distance. The triangles must outlive it.
class Judge {
public:
    /// `triangles` as worldTriangles() orders them.
    Judge(const std::vector<WorldTriangle>& triangles, std::size_t instances);

    /// How far from an edge a line still touches it, meters.
    double edge() const { return edge_; }

    /// How far a claimed hit is from where its triangle is, in tolerances of t.
    double error(const GpuRay& ray, const Hit& hit) const;

    /// Whether the claim is true: the triangle is hit, or the ray touches its edge, at that
    /// distance.
    bool holds(const GpuRay& ray, const Hit& hit) const;

    /// Whether barycentrics and distance speak of one point. Those of a sliver are less certain: an
    /// error across it is one along it, longer by the ratio of its sides.
    bool consistent(const GpuRay& ray, const Hit& hit) const;

    enum class Verdict {
        Wrong,
        Edge,      ///< the nearer of the two hits is at an edge or at an end of the ray
        Coincident ///< two triangles lie in one plane, and the ray goes through both
    };

    /// What two different answers come from.
    Verdict judge(const GpuRay& ray, const Hit& a, const Hit& b) const;

    /// Whether "anything" and "nothing" are both right: all there is to hit is hit at an edge or at
    /// an end of the ray, and there is such a thing.
    bool tieOfAny(const GpuRay& ray) const;

private:
    bool doubtful(const GpuRay& ray, const Exact& exact) const;
    const WorldTriangle& triangleOf(const Hit& hit) const;
    Exact of(const GpuRay& ray, const Hit& hit) const;

    const std::vector<WorldTriangle>& triangles_;
    std::vector<std::size_t> first_; // of an instance
    double extent_ = 0.0, edge_ = 0.0;
};

} // namespace afterglow::test
