#version 450 core
// SPDX-License-Identifier: MIT

// Finds what each ray of a list hits first.

#include "lib/bvh_trace.glsl"
#include "lib/tile.glsl"

layout(local_size_x = 64) in;

Uint4Buffer(rays);
UintBuffer(rayCounts);

// At the ray's place in the list: instance, or kBvhNoInstance; triangle; barycentrics.
writeonly uniform uimageBuffer hits;

void main() {
    uint segment, place;
    placeInList(segment, place);
    if (place >= fetchBuffer(rayCounts, int(segment)).x)
        return;
    uint index = segment * kSegmentRays + place;
    int texel = int(index * kTexelsPerRay);
    vec4 from = uintBitsToFloat(fetchBuffer(rays, texel));
    uvec4 to = fetchBuffer(rays, texel + 1);
    BvhHit hit;
    closestHit(from.xyz, uintBitsToFloat(to.xyz), from.w, hit);
    imageStore(hits, int(index),
               uvec4(hit.instance, hit.triangle, floatBitsToUint(hit.barycentrics)));
}
