// SPDX-License-Identifier: MIT
// Rays against all triangles of the scene: the nearest hit, or whether there is any.
//
// The tree has four quantized children a node (shared/bvh.h); renderer/bvh/ makes it. Triangles are
// seen from both sides. Tests hold the walk against two others, of which one is Embree's.
//
// Whoever includes this binds one buffer by its name.

#include "lib/fetch.glsl"
#include "shared/bvh.h"

Uint4Buffer(bvhRecords); // BvhNode or BvhTriangle: 3 texels

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
const float kBvhFarRounding = 1.000002;

// The key of a child that the ray does not meet: above that of any other.
const int kBvhMissed = 0x7f000000;

vec3 bvhInverse(vec3 direction) {
    vec3 smallest = mix(vec3(kBvhSmallestDirection), vec3(-kBvhSmallestDirection),
                        lessThan(direction, vec3(0.0)));
    return 1.0 / mix(direction, smallest, lessThan(abs(direction), vec3(kBvhSmallestDirection)));
}

// A ray and how it is held against planes.
struct BvhRay {
    vec3 origin, direction;
    vec3 inverse;
    bvec3 backward; // against the axis: the upper side of a box is the near one
};

// A node's grid along the ray: plane k of an axis is met at k * step + start.
struct BvhGrid {
    vec3 step, start;
    uvec3 near, far; // the planes of four children each, a byte a child
};

BvhGrid bvhGrid(BvhRay ray, uvec4 t0, uvec4 t1, uvec4 t2) {
    vec3 cell = uintBitsToFloat(((t0.www >> uvec3(0u, 8u, 16u)) & 255u) << 23u);
    uvec3 low = t1.xyz, high = uvec3(t1.w, t2.xy);
    return BvhGrid(cell * ray.inverse, (uintBitsToFloat(t0.xyz) - ray.origin) * ray.inverse,
                   mix(low, high, ray.backward), mix(high, low, ray.backward));
}

// The key by which children are visited: the bits of the distance at which the ray enters, with the
// child's place in the last two; kBvhMissed and above if it does not meet the box within [0, tMax].
//
// Distances are compared as the integers that their bits are: for floats that are not negative the
// order is the same, an entry is clamped at 0, and an exit below 0 stays below 0. llvmpipe takes
// three instructions for the minimum of two floats, and one for that of two integers.
int bvhKey(BvhGrid grid, int child, int tMax) {
    uvec3 near = (grid.near >> uint(8 * child)) & 255u, far = (grid.far >> uint(8 * child)) & 255u;
    ivec3 enters = floatBitsToInt(vec3(ivec3(near)) * grid.step + grid.start);
    ivec3 leaves = floatBitsToInt(vec3(ivec3(far)) * grid.step + grid.start);
    int entry = max(max(enters.x, enters.y), max(enters.z, 0));
    int leave = min(min(leaves.x, leaves.y), min(leaves.z, tMax));
    bool met = entry <= floatBitsToInt(intBitsToFloat(leave) * kBvhFarRounding);
    return ((met ? entry : kBvhMissed) & ~3) | child;
}

void bvhOrder(inout int a, inout int b) {
    int least = min(a, b);
    b = max(a, b);
    a = least;
}

// Makes `hit` the triangle if it is one and is met before hit.t. Signed volumes on the three edges:
// both triangles of a shared edge find the same number for it, negated, so no ray slips between
// them. Davidovic et al., "3D Rasterization: A Bridge between Rasterization and Ray Casting", GI
// 2012.
void bvhIntersect(BvhRay ray, bool isTriangle, uvec4 t0, uvec4 t1, uvec4 t2, inout BvhHit hit) {
    vec3 v0 = uintBitsToFloat(t0.xyz) - ray.origin;
    vec3 v1 = uintBitsToFloat(t1.xyz) - ray.origin;
    vec3 v2 = uintBitsToFloat(t2.xyz) - ray.origin;
    vec3 e0 = v2 - v0, e1 = v0 - v1, e2 = v1 - v2;
    float u = dot(cross(e0, v2 + v0), ray.direction);
    float v = dot(cross(e1, v0 + v1), ray.direction);
    float w = dot(cross(e2, v1 + v2), ray.direction);
    vec3 normal = cross(e0, e1);
    float slope = dot(normal, ray.direction);
    float t = dot(normal, v0) / slope;
    bool inside = min(min(u, v), w) >= 0.0 || max(max(u, v), w) <= 0.0;
    if (isTriangle && inside && slope != 0.0 && t > 0.0 && t < hit.t) {
        hit.t = t;
        hit.instance = t0.w & kBvhInstanceMask;
        hit.triangle = t1.w;
        hit.barycentrics = vec2(u, v) / (u + v + w);
    }
}

// One step is the same for every lane, whether its record is a node or a triangle, so that no lane
// waits for others; what does not apply is not used. Stores to the stack are not conditional: a
// software rasterizer makes a branch of each lane's masked store.
bool bvhTrace(vec3 origin, vec3 direction, float tMax, bool any, out BvhHit hit) {
    hit = BvhHit(tMax, kBvhNoInstance, 0u, vec2(0.0));
    vec3 inverse = bvhInverse(direction);
    BvhRay ray = BvhRay(origin, direction, inverse, lessThan(inverse, vec3(0.0)));
    uint stack[kBvhMaxDepth + 2u]; // an end, the deferred, and one above them that is not kept
    stack[0] = 0u;
    int top = 1;
    uint group = 0u; // the deferred ones that come next
    uint record = kBvhRoot;
    while (record != 0u) {
        int texel = int(record * kBvhTexelsPerRecord);
        uvec4 t0 = fetchBuffer(bvhRecords, texel);
        uvec4 t1 = fetchBuffer(bvhRecords, texel + 1);
        uvec4 t2 = fetchBuffer(bvhRecords, texel + 2);
        bool isTriangle = (t0.w & kBvhTriangle) != 0u;

        BvhGrid grid = bvhGrid(ray, t0, t1, t2);
        int limit = floatBitsToInt(hit.t);
        int k0 = bvhKey(grid, 0, limit), k1 = bvhKey(grid, 1, limit);
        int k2 = bvhKey(grid, 2, limit), k3 = bvhKey(grid, 3, limit);
        bvhOrder(k0, k1);
        bvhOrder(k2, k3);
        bvhOrder(k0, k2);
        bvhOrder(k1, k3);
        bvhOrder(k1, k2);
        uint deferred = uint(k1 < kBvhMissed) + uint(k2 < kBvhMissed) + uint(k3 < kBvhMissed);
        uint block = t2.z;
        uint ofNode = (block << kBvhGroupBlockShift) | (deferred << kBvhGroupCountShift) |
                      (uint(k3 & 3) << 4u) | (uint(k2 & 3) << 2u) | uint(k1 & 3);

        bvhIntersect(ray, isTriangle, t0, t1, t2, hit);

        bool goesDown = !isTriangle && k0 < kBvhMissed;
        bool defers = goesDown && deferred > 0u;
        uint next = isTriangle ? t2.w : (goesDown ? 4u * block + uint(k0 & 3) : 0u);
        stack[top] = group;
        top += int(defers && group != 0u);
        group = defers ? ofNode : group;
        if (next == 0u) {
            bool empty = group == 0u;
            top -= int(empty);
            group = empty ? stack[top] : group;
            next = group == 0u ? 0u : 4u * (group >> kBvhGroupBlockShift) + (group & 3u);
            uint left = ((group >> kBvhGroupCountShift) & 3u) - 1u;
            uint places = (group & 63u) >> 2u;
            group = left == 0u || group == 0u
                        ? 0u
                        : (group & ~255u) | (left << kBvhGroupCountShift) | places;
        }
        record = any && hit.instance != kBvhNoInstance ? 0u : next;
    }
    return hit.instance != kBvhNoInstance;
}

// Returns whether anything is at origin + t * direction with t in (0, tMax).
bool occluded(vec3 origin, vec3 direction, float tMax) {
    BvhHit hit;
    return bvhTrace(origin, direction, tMax, true, hit);
}

// Finds the nearest such thing. Without one, it returns false and `hit` has t = tMax and no
// instance.
bool closestHit(vec3 origin, vec3 direction, float tMax, out BvhHit hit) {
    return bvhTrace(origin, direction, tMax, false, hit);
}
