#version 450 core
// SPDX-License-Identifier: MIT

// Traces the rays of a list until anything is hit. With SHADOWS, a pixel whose ray hits something
// loses its light, in two signals with SIGNALS 2; with PENDING, one whose ray hits nothing gets
// what waits for that; with AMBIENT_OCCLUSION, one whose ray hits nothing gets the light of the
// surroundings.

#ifndef SIGNALS
#define SIGNALS 1
#endif

#include "lib/encoding.glsl"
#include "lib/fetch.glsl"
#include "lib/tile.glsl"
#include "shared/ray_list.h"

#include "lib/bvh_trace.glsl"
#ifdef AMBIENT_OCCLUSION
#include "lib/frame.glsl"
#endif

layout(local_size_x = 64) in;

Uint4Buffer(rays);
UintBuffer(rayCounts);

layout(rgba32f) uniform image2D raw;
#if SIGNALS > 1
layout(rgba32f) uniform image2D raw1;
#endif
#ifdef PENDING
Float4Texture(pending);
#if SIGNALS > 1
Float4Texture(pending1);
#endif
#endif

void main() {
    uint segment, place;
    placeInList(segment, place);
    if (place >= fetchBuffer(rayCounts, int(segment)).x)
        return;
    int texel = int((segment * kSegmentRays + place) * kTexelsPerRay);
    vec4 from = uintBitsToFloat(fetchBuffer(rays, texel));
    uvec4 to = fetchBuffer(rays, texel + 1);
    bool hidden = occluded(from.xyz, uintBitsToFloat(to.xyz), from.w);
    ivec2 p = unpackPixel(to.w);
#ifdef SHADOWS
    if (hidden) {
        imageStore(raw, p, vec4(0.0));
#if SIGNALS > 1
        imageStore(raw1, p, vec4(0.0));
#endif
    }
#endif
#ifdef PENDING
    if (!hidden) {
        imageStore(raw, p, imageLoad(raw, p) + fetch(pending, p));
#if SIGNALS > 1
        imageStore(raw1, p, imageLoad(raw1, p) + fetch(pending1, p));
#endif
    }
#endif
#ifdef AMBIENT_OCCLUSION
    if (!hidden)
        imageStore(raw, p, imageLoad(raw, p) + vec4(frame.ambient, 0.0));
#endif
}
