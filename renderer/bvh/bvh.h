// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/base/large_array.h"
#include "renderer/bvh/aabb.h"
#include "shared/bvh.h"

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace afterglow {

/// One record of the tree that shaders walk: a gpu::BvhNode or a gpu::BvhTriangle.
struct BvhRecord {
    std::array<std::uint32_t, 12> words;

    BvhRecord() = default; ///< of no particular bits
    BvhRecord(const gpu::BvhNode& node) : words(std::bit_cast<decltype(words)>(node)) {}
    BvhRecord(const gpu::BvhTriangle& triangle) : words(std::bit_cast<decltype(words)>(triangle)) {}

    bool isTriangle() const { return (words[3] & gpu::kBvhTriangle) != 0; }
    gpu::BvhNode node() const { return std::bit_cast<gpu::BvhNode>(words); }
    gpu::BvhTriangle triangle() const { return std::bit_cast<gpu::BvhTriangle>(words); }
    bool operator==(const BvhRecord&) const = default;
};

/// A record of a triangle that no ray meets: what stands where a node has no child.
BvhRecord nullRecord();

/// Where a tree begins. All below its root is in an array of records: whole blocks of
/// gpu::kBvhWidth, to which links are places in that array.
struct BvhRoot {
    BvhRecord record{}; ///< a node, even if nothing is in the tree
    Aabb bounds;        ///< of everything; empty if nothing is in the tree
};

struct BvhOptions {
    /// The largest number of leaves in one place of a block: 1 to kBvhMaxLeafSize. More than 1 only
    /// if leaves are triangles, which are linked one to the next.
    std::uint32_t maxLeafSize = 4;
    std::uint32_t maxDepth = 40; ///< of nodes on a path; holds 2^maxDepth leaves at least
    unsigned threads = 0;        ///< 0: as many as the machine has. The tree is the same for each.
};
inline constexpr std::uint32_t kBvhMaxLeafSize = 4;

/// Builds a tree of four children a node over leaves whose boxes have numbers that are finite, and
/// adds its records behind those that are there, which are whole blocks: binned surface area
/// heuristic (Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007), the
/// largest child split again until there are four. `leaves` are triangles, or the roots of other
/// trees with maxLeafSize 1. Throws Error if there are more than 24 bits of blocks can count.
BvhRoot buildBvh(LargeArray<BvhRecord>& records, std::span<const Aabb> boxes,
                 std::span<const BvhRecord> leaves, const BvhOptions& options = {});

/// Returns the box of a triangle's corners.
Aabb boundsOf(const gpu::BvhTriangle& triangle);

/// Fits a tree to triangles that have moved: its root, its bounds and all nodes between; it keeps
/// its shape.
void refitBvh(BvhRoot& root, std::span<BvhRecord> records);

/// Returns a node over up to four boxes, of which empty ones are no children. Boxes are enlarged by
/// 7e-7 of the largest coordinate, and outwards to the steps of the node's grid.
gpu::BvhNode packNode(const std::array<Aabb, gpu::kBvhWidth>& children, std::uint32_t block);

/// Returns the box of child `child` as a walk sees it; empty if there is none.
Aabb childBox(const gpu::BvhNode& node, std::uint32_t child);

/// Returns how many nodes the longest path from a root has.
std::uint32_t depthOf(const BvhRecord& root, std::span<const BvhRecord> records);

/// Returns the cost that the surface area heuristic expects of a ray: records fetched, given that
/// it meets the root's box.
double sahCost(const BvhRecord& root, std::span<const BvhRecord> records);

} // namespace afterglow
