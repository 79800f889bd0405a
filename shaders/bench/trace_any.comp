#version 450 core
// SPDX-License-Identifier: MIT

// Traces the rays of a list until anything is hit, and writes whether there is something.

#include "lib/fetch.glsl"
#include "lib/tile.glsl"
#include "shared/ray_list.h"

#include "lib/bvh_trace.glsl"

layout(local_size_x = 64) in;

Uint4Buffer(rays);
UintBuffer(rayCounts);

writeonly uniform uimageBuffer hits; // a place each: kBvhNoInstance in x where nothing is

void main() {
    uint segment, place;
    placeInList(segment, place);
    if (place >= fetchBuffer(rayCounts, int(segment)).x)
        return;
    int index = int(segment * kSegmentRays + place);
    vec4 from = uintBitsToFloat(fetchBuffer(rays, index * int(kTexelsPerRay)));
    vec3 direction = uintBitsToFloat(fetchBuffer(rays, index * int(kTexelsPerRay) + 1).xyz);
    bool met = occluded(from.xyz, direction, from.w);
    imageStore(hits, index, uvec4(met ? 0u : kBvhNoInstance, 0u, 0u, 0u));
}
