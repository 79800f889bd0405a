// SPDX-License-Identifier: MIT
#pragma once
#include "shared/interop.h"
SHARED_BEGIN

// A link says where a child is. Bit 31 clear: it is the index of an inner node. Bit 31 set: a leaf;
// bits 28 to 30 hold how many items it has (0 to 4), bits 0 to 27 the first of them.
const uint kBvhLeaf = 0x80000000u;
const uint kBvhCountShift = 28u;
const uint kBvhCountMask = 7u;
const uint kBvhFirstMask = 0x0fffffffu;
const uint kBvhMaxLeafSize = 4u;
const uint kBvhNone = 0xffffffffu; // no link; also "no instance"

// No path from a root to a leaf has more inner nodes than this, which the builder guarantees. A
// walk defers at most one child at each of them, so a stack of this many links (and its end) never
// overflows.
const uint kBvhMaxDepth = 40u;

// Bounds of both children beside their links, so that a child outside the ray is never fetched.
// Aila and Laine, "Understanding the Efficiency of Ray Traversal on GPUs", HPG 2009.
struct BvhNode {
    vec4 child0xy; // min.x, max.x, min.y, max.y
    vec4 child1xy;
    vec4 childrenZ; // child 0: min.z, max.z; child 1: min.z, max.z
    uint link0;
    uint link1;
    uint pad0;
    uint pad1;
};

// The corners in the space of the tree: the world, or the mesh's own where the instance moves.
struct BvhTriangle {
    vec3 v0;
    uint instance; // index into Scene::instances; kBvhNone in the tree of a mesh that moves
    vec3 v1;
    uint triangle; // index into Mesh::triangles
    vec3 v2;
    uint pad;
};

// A moving instance.
struct BvhInstance {
    vec4 objectFromWorldX; // rows of an affine matrix
    vec4 objectFromWorldY;
    vec4 objectFromWorldZ;
    uint instance; // index into Scene::instances
    uint root;     // the root of its mesh's tree, among the nodes of all trees
    uint pad0;
    uint pad1;
};

struct BvhParams {
    uint movingInstances; // how many the top-level tree holds; 0: there is nothing to walk
    uint topRoot;         // its root: an entry of bvhInstances
    uint pad0;
    uint pad1;
};

SHARED_END
