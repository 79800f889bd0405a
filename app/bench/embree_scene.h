// SPDX-License-Identifier: MIT
#pragma once

#include "app/bench/ray_lists.h"
#include "renderer/bvh/bvh.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace afterglow {

/// Embree 3 over the triangles of a scene, at medium quality and without its robust mode.
class EmbreeScene {
public:
    /// Returns whether the program was built for it and this machine has its library.
    static bool isThere();

    /// Builds its tree. Error where Embree is not there.
    EmbreeScene(std::span<const gpu::BvhTriangle> triangles, unsigned threads);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    double buildMilliseconds() const; ///< of rtcCommitScene()

    /// Traces all rays, on all threads, and notes of each whether it hits something.
    void trace(std::span<const ListedRay> rays, bool anyHit, std::span<std::uint8_t> hits) const;

    /// Returns what sahCost() says of the tree that Embree's builder makes over boxes, with four
    /// children a node and leaves as large as ours. Its boxes are exact, those of our nodes are
    /// rounded outwards.
    static double sahCost(std::span<const Aabb> boxes, unsigned threads);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace afterglow
