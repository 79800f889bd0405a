// SPDX-License-Identifier: MIT
// Rays against all triangles of the scene: the nearest hit, or whether there is any.
//
// A walk in the manner of Aila and Laine, "Understanding the Efficiency of Ray Traversal on GPUs",
// HPG 2009, over what renderer/bvh/scene_bvh.h makes: one
// tree of what stands still, then the trees of the moving instances whose boxes the ray meets.
// Triangles are seen from both sides. renderer/bvh/bvh_trace.cpp does the same in double precision.
//
// Whoever includes this has declared `bvhParams` before: a BvhParams, as a member of a uniform
// block without an instance name or by `#define bvhParams frame.bvh`. It binds three buffers by
// their names.

#include "lib/fetch.glsl"
#include "shared/bvh.h"

Uint4Buffer(bvhNodes);     // BvhNode: 4 texels
Uint4Buffer(bvhTriangles); // BvhTriangle: 3 texels
Uint4Buffer(bvhInstances); // BvhInstance, then BvhNode: 4 texels

struct BvhHit {
    float t;           // in units of the ray's direction
    uint instance;     // index into Scene::instances
    uint triangle;     // index into Mesh::triangles
    vec2 barycentrics; // weights of corners 1 and 2
};

// A component of a direction is at least this, so that its inverse is finite and 0 * infinity,
// which is not a number, cannot come up.
const float kBvhSmallestDirection = 1e-18;

// Widens the far end of a slab interval by more than its rounding, with a division of 2.5 ulp.
// Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013.
const float kBvhFarRounding = 1.000001;

vec3 bvhInverse(vec3 direction) {
    vec3 smallest = mix(vec3(kBvhSmallestDirection), vec3(-kBvhSmallestDirection),
                        lessThan(direction, vec3(0.0)));
    return 1.0 / mix(direction, smallest, lessThan(abs(direction), vec3(kBvhSmallestDirection)));
}

// Where the ray enters and leaves a box, within [0, tMax]. It misses if the first is greater.
vec2 bvhClip(vec3 origin, vec3 inverse, vec4 xy, vec2 z, float tMax) {
    vec3 a = (vec3(xy.x, xy.z, z.x) - origin) * inverse;
    vec3 b = (vec3(xy.y, xy.w, z.y) - origin) * inverse;
    vec3 low = min(a, b), high = max(a, b);
    return vec2(max(max(low.x, low.y), max(low.z, 0.0)),
                min(min(high.x, high.y), min(high.z, tMax)) * kBvhFarRounding);
}

// The children of a node that the ray meets: the nearer one, or kBvhNone; then the other, or
// kBvhNone.
uvec2 bvhChildren(vec3 origin, vec3 inverse, float tMax, uvec4 child0xy, uvec4 child1xy,
                  uvec4 childrenZ, uvec2 links) {
    vec4 z = uintBitsToFloat(childrenZ);
    vec2 in0 = bvhClip(origin, inverse, uintBitsToFloat(child0xy), z.xy, tMax);
    vec2 in1 = bvhClip(origin, inverse, uintBitsToFloat(child1xy), z.zw, tMax);
    uvec2 met = uvec2(in0.x <= in0.y ? links.x : kBvhNone, in1.x <= in1.y ? links.y : kBvhNone);
    bool swap = met.x == kBvhNone || (met.y != kBvhNone && in1.x < in0.x);
    return swap ? met.yx : met;
}

// Makes `hit` the triangle if it is met before hit.t. Signed volumes on the three edges: both
// triangles of a shared edge find the same number for it, negated, so no ray slips between them.
// Davidovic et al., "3D Rasterization: A Bridge between Rasterization and Ray Casting", GI 2012.
void bvhIntersect(uint index, uint movingInstance, vec3 origin, vec3 direction, inout BvhHit hit) {
    int texel = int(index) * 3;
    uvec4 t0 = fetchBuffer(bvhTriangles, texel);
    uvec4 t1 = fetchBuffer(bvhTriangles, texel + 1);
    uvec4 t2 = fetchBuffer(bvhTriangles, texel + 2);
    vec3 v0 = uintBitsToFloat(t0.xyz) - origin;
    vec3 v1 = uintBitsToFloat(t1.xyz) - origin;
    vec3 v2 = uintBitsToFloat(t2.xyz) - origin;
    vec3 e0 = v2 - v0, e1 = v0 - v1, e2 = v1 - v2;
    float u = dot(cross(e0, v2 + v0), direction);
    float v = dot(cross(e1, v0 + v1), direction);
    float w = dot(cross(e2, v1 + v2), direction);
    vec3 normal = cross(e0, e1);
    float slope = dot(normal, direction);
    float t = dot(normal, v0) / slope;
    bool inside = min(min(u, v), w) >= 0.0 || max(max(u, v), w) <= 0.0;
    if (inside && slope != 0.0 && t > 0.0 && t < hit.t) {
        hit.t = t;
        hit.instance = min(t0.w, movingInstance); // one of them is kBvhNone
        hit.triangle = t1.w;
        hit.barycentrics = vec2(u, v) / (u + v + w);
    }
}

// Walks one tree of triangles. With `any`, it ends at the first hit.
//
// Nodes are visited in rounds of two between leaves, and stores to the stack are not conditional: a
// lane that waits at a leaf does harmless work. A software rasterizer makes a branch of each lane's
// masked store, and mispredicted ones took a third of the time with a loop until every lane has a
// leaf.
void bvhWalk(uint root, uint movingInstance, vec3 origin, vec3 direction, bool any,
             inout BvhHit hit) {
    const int kNodesPerRound = 2;
    vec3 inverse = bvhInverse(direction);
    uint stack[kBvhMaxDepth + 2u]; // an end, the deferred, and one above them that is not kept
    int deferred = 1;
    stack[0] = kBvhNone;
    uint link = root;
    while (link != kBvhNone) {
        for (int i = 0; i < kNodesPerRound; ++i) {
            bool inner = (link & kBvhLeaf) == 0u;
            int texel = inner ? int(link) * 4 : 0;
            uvec2 children =
                bvhChildren(origin, inverse, hit.t, fetchBuffer(bvhNodes, texel),
                            fetchBuffer(bvhNodes, texel + 1), fetchBuffer(bvhNodes, texel + 2),
                            fetchBuffer(bvhNodes, texel + 3).xy);
            bool push = inner && children.y != kBvhNone;
            bool pop = inner && children.x == kBvhNone;
            stack[deferred] = children.y;
            deferred += int(push) - int(pop);
            uint deferredLink = stack[deferred];
            link = pop ? deferredLink : (inner ? children.x : link);
        }
        if ((link & kBvhLeaf) != 0u && link != kBvhNone) {
            uint item = link & kBvhFirstMask;
            uint end = item + ((link >> kBvhCountShift) & kBvhCountMask);
            while (item < end) {
                bvhIntersect(item, movingInstance, origin, direction, hit);
                ++item;
            }
            bool done = any && hit.instance != kBvhNone;
            link = done ? kBvhNone : stack[--deferred];
        }
    }
}

// One loop serves the still tree and the moving ones, so that the walk is in the program only once.
bool bvhTrace(vec3 origin, vec3 direction, float tMax, bool any, out BvhHit hit) {
    hit = BvhHit(tMax, kBvhNone, 0u, vec2(0.0));
    vec3 inverse = bvhInverse(direction);
    uint stack[kBvhMaxDepth + 1u]; // of the top-level tree
    int deferred = 1;
    stack[0] = kBvhNone;
    uint link = bvhParams.movingInstances > 0u ? bvhParams.topRoot : kBvhNone;

    uint root = 0u;
    uint movingInstance = kBvhNone;
    vec3 localOrigin = origin, localDirection = direction;
    while (root != kBvhNone) {
        bvhWalk(root, movingInstance, localOrigin, localDirection, any, hit);
        if (any && hit.instance != kBvhNone)
            link = kBvhNone;
        root = kBvhNone;
        while ((link & kBvhLeaf) == 0u) {
            int texel = int(link) * 4;
            uvec2 children = bvhChildren(origin, inverse, hit.t, fetchBuffer(bvhInstances, texel),
                                         fetchBuffer(bvhInstances, texel + 1),
                                         fetchBuffer(bvhInstances, texel + 2),
                                         fetchBuffer(bvhInstances, texel + 3).xy);
            link = children.x;
            if (children.y != kBvhNone)
                stack[deferred++] = children.y;
            if (link == kBvhNone)
                link = stack[--deferred];
        }
        if (link != kBvhNone) { // a leaf, which holds one instance
            int texel = int(link & kBvhFirstMask) * 4;
            mat3x4 objectFromWorld = mat3x4(uintBitsToFloat(fetchBuffer(bvhInstances, texel)),
                                            uintBitsToFloat(fetchBuffer(bvhInstances, texel + 1)),
                                            uintBitsToFloat(fetchBuffer(bvhInstances, texel + 2)));
            uvec2 record = fetchBuffer(bvhInstances, texel + 3).xy;
            localOrigin = vec4(origin, 1.0) * objectFromWorld;
            localDirection = vec4(direction, 0.0) * objectFromWorld;
            movingInstance = record.x;
            root = record.y;
            link = stack[--deferred];
        }
    }
    return hit.instance != kBvhNone;
}

// Whether anything is at origin + t * direction with t in (0, tMax).
bool occluded(vec3 origin, vec3 direction, float tMax) {
    BvhHit hit;
    return bvhTrace(origin, direction, tMax, true, hit);
}

// The nearest such thing. Without one, it returns false and `hit` has t = tMax and no instance.
bool closestHit(vec3 origin, vec3 direction, float tMax, out BvhHit hit) {
    return bvhTrace(origin, direction, tMax, false, hit);
}
