// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/bvh/aabb.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace afterglow::test {

// A tree of two children a node over all triangles, and a walk over it in GLSL: a third opinion
// beside the program's own tree and Embree.

/// A link says where a child is. Bit 31 clear: it is the index of an inner node. Bit 31 set: a
/// leaf; bits 28 to 30 hold how many boxes it has (0 to 4), bits 0 to 27 the first of them.
inline std::uint32_t leafLink(std::uint32_t first, std::uint32_t count) {
    return 0x80000000u | (count << 28) | first;
}
inline bool isLeaf(std::uint32_t link) {
    return (link & 0x80000000u) != 0;
}

/// No path has more inner nodes.
inline constexpr std::uint32_t kBinaryMaxDepth = 40;

/// Bounds of both children beside their links. Aila and Laine, "Understanding the Efficiency of Ray
/// Traversal on GPUs", HPG 2009.
struct BinaryNode {
    glm::vec4 child0xy; ///< min.x, max.x, min.y, max.y
    glm::vec4 child1xy;
    glm::vec4 childrenZ; ///< child 0: min.z, max.z; child 1: min.z, max.z
    std::uint32_t link0, link1, pad0, pad1;
};

struct BinaryBvh {
    /// nodes[0] is the root. Boxes in nodes are a little larger than what they hold: by some 2e-7
    /// of the largest coordinate of all.
    std::vector<BinaryNode> nodes;
    std::vector<std::uint32_t> order; ///< leaf ranges index this, this indexes the boxes
    Aabb bounds;                      ///< of everything
};

BinaryBvh buildBinaryBvh(std::span<const Aabb> boxes);

/// GLSL: `bool binaryTrace(vec3 origin, vec3 direction, float tMax, bool any, out BvhHit hit)` over
/// the buffers binaryNodes and binaryTriangles (BvhTriangle). Needs lib/bvh_trace.glsl before it,
/// for the type of a hit, the inverse of a direction and the test of a triangle.
extern const std::string_view kBinaryTrace;

} // namespace afterglow::test
