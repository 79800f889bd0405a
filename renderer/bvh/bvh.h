// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/bvh/aabb.h"
#include "shared/bvh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace afterglow {

/// A bounding volume hierarchy over boxes. It does not know what is in them.
struct Bvh {
    /// nodes[0] is the root; it is there even if nothing else is. Boxes in nodes are a little
    /// larger than what they hold: by some 2e-7 of the largest coordinate of all.
    std::vector<gpu::BvhNode> nodes;
    std::vector<std::uint32_t> order; ///< leaf ranges index this, this indexes the boxes
    Aabb bounds;                      ///< of everything
};

/// Builds from boxes whose numbers are finite, at most 2^28 of them; Error if there are more.
/// Binned surface area heuristic (Wald, "On fast Construction of SAH-based Bounding Volume
/// Hierarchies", 2007). Leaves hold at most `maxLeafSize` boxes, in [1, kBvhMaxLeafSize], and fewer
/// where the heuristic says that splitting pays. No path has more than kBvhMaxDepth nodes, whatever
/// the boxes: many identical ones are split by halves.
Bvh buildBvh(std::span<const Aabb> boxes, std::uint32_t maxLeafSize = gpu::kBvhMaxLeafSize);

/// How many inner nodes the longest path from `root` has.
std::uint32_t depthOf(std::span<const gpu::BvhNode> nodes, std::uint32_t root = 0);

inline bool isLeaf(std::uint32_t link) {
    return (link & gpu::kBvhLeaf) != 0;
}
inline std::uint32_t leafFirst(std::uint32_t link) {
    return link & gpu::kBvhFirstMask;
}
inline std::uint32_t leafCount(std::uint32_t link) {
    return (link >> gpu::kBvhCountShift) & gpu::kBvhCountMask;
}
inline std::uint32_t leafLink(std::uint32_t first, std::uint32_t count) {
    return gpu::kBvhLeaf | (count << gpu::kBvhCountShift) | first;
}

} // namespace afterglow
