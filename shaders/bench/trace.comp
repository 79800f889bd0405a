#version 450 core
// SPDX-License-Identifier: MIT

// Traces the rays of a list and writes what each hits: the nearest triangle, or with ANY_HIT only
// whether there is one.

#include "lib/fetch.glsl"
#include "lib/tile.glsl"
#include "shared/ray_list.h"

#include "lib/bvh_trace.glsl"

layout(local_size_x = 64) in;

Uint4Buffer(rays);
UintBuffer(rayCounts);

writeonly uniform uimageBuffer hits; // a place each: t, instance or kBvhNoInstance, triangle, 0

void main() {
    uint segment, place;
    placeInList(segment, place);
    if (place >= fetchBuffer(rayCounts, int(segment)).x)
        return;
    int index = int(segment * kSegmentRays + place);
    vec4 from = uintBitsToFloat(fetchBuffer(rays, index * int(kTexelsPerRay)));
    vec3 direction = uintBitsToFloat(fetchBuffer(rays, index * int(kTexelsPerRay) + 1).xyz);
#ifdef ANY_HIT
    bool met = occluded(from.xyz, direction, from.w);
    imageStore(hits, index, uvec4(floatBitsToUint(from.w), met ? 0u : kBvhNoInstance, 0u, 0u));
#else
    BvhHit hit;
    closestHit(from.xyz, direction, from.w, hit);
    imageStore(hits, index, uvec4(floatBitsToUint(hit.t), hit.instance, hit.triangle, 0u));
#endif
}
