// SPDX-License-Identifier: MIT
// A walk in the manner of Aila and Laine, "Understanding the Efficiency of Ray Traversal on GPUs",
// HPG 2009.

#include "tests/gl/binary_bvh.h"

namespace afterglow::test {

const std::string_view kBinaryTrace = R"(
Uint4Buffer(binaryNodes);     // BinaryNode: 4 texels
Uint4Buffer(binaryTriangles); // BvhTriangle: 3 texels
const uint kBinaryNone = 0xffffffffu;

// Where the ray enters and leaves a box, within [0, tMax]. It misses if the first is greater.
vec2 binaryClip(vec3 origin, vec3 inverse, vec4 xy, vec2 z, float tMax) {
    vec3 a = (vec3(xy.x, xy.z, z.x) - origin) * inverse;
    vec3 b = (vec3(xy.y, xy.w, z.y) - origin) * inverse;
    vec3 low = min(a, b), high = max(a, b);
    return vec2(max(max(low.x, low.y), max(low.z, 0.0)),
                min(min(high.x, high.y), min(high.z, tMax)) * 1.000001);
}

// The children of a node that the ray meets: the nearer one, or kBinaryNone; then the other, or
// kBinaryNone.
uvec2 binaryChildren(vec3 origin, vec3 inverse, float tMax, uvec4 child0xy, uvec4 child1xy,
                  uvec4 childrenZ, uvec2 links) {
    vec4 z = uintBitsToFloat(childrenZ);
    vec2 in0 = binaryClip(origin, inverse, uintBitsToFloat(child0xy), z.xy, tMax);
    vec2 in1 = binaryClip(origin, inverse, uintBitsToFloat(child1xy), z.zw, tMax);
    uvec2 met = uvec2(in0.x <= in0.y ? links.x : kBinaryNone, in1.x <= in1.y ? links.y : kBinaryNone);
    bool swap = met.x == kBinaryNone || (met.y != kBinaryNone && in1.x < in0.x);
    return swap ? met.yx : met;
}

void binaryIntersect(BvhRay ray, uint item, inout BvhHit hit) {
    int texel = int(item) * 3;
    bvhIntersect(ray, true, fetchBuffer(binaryTriangles, texel),
                 fetchBuffer(binaryTriangles, texel + 1), fetchBuffer(binaryTriangles, texel + 2),
                 hit);
}

bool binaryTrace(vec3 origin, vec3 direction, float tMax, bool any, out BvhHit hit) {
    hit = BvhHit(tMax, kBvhNoInstance, 0u, vec2(0.0));
    BvhRay ray = BvhRay(origin, direction, bvhInverse(direction), bvec3(false));
    const int kNodesPerRound = 2;
    vec3 inverse = bvhInverse(direction);
    uint stack[42]; // an end, the deferred, and one above them that is not kept
    int deferred = 1;
    stack[0] = kBinaryNone;
    uint link = 0u;
    while (link != kBinaryNone) {
        for (int i = 0; i < kNodesPerRound; ++i) {
            bool inner = (link & 0x80000000u) == 0u;
            int texel = inner ? int(link) * 4 : 0;
            uvec2 children =
                binaryChildren(origin, inverse, hit.t, fetchBuffer(binaryNodes, texel),
                            fetchBuffer(binaryNodes, texel + 1), fetchBuffer(binaryNodes, texel + 2),
                            fetchBuffer(binaryNodes, texel + 3).xy);
            bool push = inner && children.y != kBinaryNone;
            bool pop = inner && children.x == kBinaryNone;
            stack[deferred] = children.y;
            deferred += int(push) - int(pop);
            uint deferredLink = stack[deferred];
            link = pop ? deferredLink : (inner ? children.x : link);
        }
        if ((link & 0x80000000u) != 0u && link != kBinaryNone) {
            uint item = link & 0x0fffffffu;
            uint end = item + ((link >> 28u) & 7u);
            while (item < end) {
                binaryIntersect(ray, item, hit);
                ++item;
            }
            bool done = any && hit.instance != kBvhNoInstance;
            link = done ? kBinaryNone : stack[--deferred];
        }
    }
    return hit.instance != kBvhNoInstance;
}
)";

} // namespace afterglow::test
