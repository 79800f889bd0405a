// SPDX-License-Identifier: MIT
#pragma once
#include "shared/interop.h"
SHARED_BEGIN

// The tree over all triangles of the scene: one array of records of three texels, each a node or a
// triangle. Records come in blocks of four, and child k of a node is record 4 * block + k, be it a
// node or a triangle. Record 0 is a triangle that no ray meets, so that 0 can stand for "none".
const uint kBvhWidth = 4u;
const uint kBvhTexelsPerRecord = 3u;
const uint kBvhRoot = 1u; // the record at which a walk begins: a node

// Bit 31 of the last word of the first texel tells a triangle from a node.
const uint kBvhTriangle = 0x80000000u;
// The instance of a triangle, in the lower bits of that word. The bits between are free for what a
// walk has to know of a triangle before it counts as hit.
const uint kBvhInstanceMask = 0x00ffffffu;
const uint kBvhNoInstance = 0xffffffffu; // of a ray that hits nothing

// A group of deferred children of one node in one word: bits 0 to 5 hold the places of up to three
// of them in the node's block, two bits each, the next to visit lowest; bits 6 and 7 how many there
// are; the others the block. No child: 0.
const uint kBvhGroupCountShift = 6u;
const uint kBvhGroupBlockShift = 8u;
const uint kBvhMaxBlocks = 1u << 24u;

// No path from a root to a triangle has more nodes than this, which the builder guarantees. A walk
// defers at most one group at each of them.
const uint kBvhMaxDepth = 62u;

// The boxes of four children, in steps of a grid. Ylitie, Karras and Laine, "Efficient Incoherent
// Ray Traversal on GPUs Through Compressed Wide BVHs", HPG 2017, section 3.1, with four instead of
// eight children.
struct BvhNode {
    vec3 origin;    // of the grid, meters, world
    uint exponents; // of the step along x, y and z: a byte each, as in the bits of a float
    uint lowX;      // the lower sides of children 0 to 3: a byte each, the first one lowest
    uint lowY;
    uint lowZ;
    uint highX; // the upper sides; an empty child has 255 below and 0 above
    uint highY;
    uint highZ;
    uint block; // of the children
    uint pad;
};

// The corners, in the world as it stands.
struct BvhTriangle {
    vec3 v0;
    uint instance; // index into Scene::instances, and kBvhTriangle
    vec3 v1;
    uint triangle; // index into Mesh::triangles
    vec3 v2;
    uint next; // the record of the leaf's next triangle; 0 at the end
};

SHARED_END
