#version 450 core
// SPDX-License-Identifier: MIT

// Forward projection, first half: every stratum of the previous frame offers one surface sample to
// the stratum where it lands. Schied et al. 2018, section 4.1. Departure: not the first to arrive
// wins but the largest of hashed keys, so that a frame is the same in whatever order its threads
// run.

#include "lib/forward.glsl"
#include "lib/frame.glsl"
#include "lib/geometry.glsl"
#include "lib/seed.glsl"
#include "lib/strata.glsl"
#include "lib/view.glsl"
#include "shared/denoise_params.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;

Uint4Texture(previousVisibility);
UintTexture(previousSeeds);
Uint4Texture(visibility);
layout(r32ui) uniform uimage2D owners;
writeonly uniform uimage2D claims; // fate so far, pixel where it landed

const float kDepthTolerance = 0.01; // of the sample's depth

const uint kFrameMask = (1u << 18) - 1u; // of a seed's frame

// Whether the surface seen at the landing pixel is the sample's: the same instance, and its
// triangle's plane, extended to the exact landing position, at the same depth.
uint fateAt(ivec2 q, vec2 landing, uvec4 sampled, float depth) {
    uvec4 seen = fetch(visibility, q);
    if (seen.x != sampled.x)
        return kFateInstance;
    Triangle t =
        worldTriangle(triangleVertices(seen.x - 1u, seen.y), instanceTransform(seen.x - 1u, false));
    vec3 normal = cross(t.edge1, t.edge2);
    vec3 direction = worldRay(landing);
    float along = dot(normal, direction);
    float planeDepth = dot(normal, t.corner - frame.cameraPosition) / along;
    float centerDepth = -(frame.viewFromWorld * vec4(pointOn(t, uintBitsToFloat(seen.zw)), 1.0)).z;
    bool edgeOn = abs(along) < 1e-3 * length(normal) * length(direction);
    float seenDepth = edgeOn ? centerDepth : planeDepth;
    return abs(seenDepth - depth) <= kDepthTolerance * depth ? kFateCarried : kFateDepth;
}

uint offer(ivec2 s, out ivec2 landed) {
    landed = ivec2(0);
    if (frame.historyValid == 0u)
        return kFateNone;
    uint previousFrame = frame.frame - 1u;
    ivec2 source = candidatePixel(s, previousFrame);
    uvec4 sampled = fetch(previousVisibility, source);
    if (sampled.x == 0u)
        return kFateBackground;
    // A seed of an older frame marks a pixel that was a gradient sample itself: used for a second
    // time, its random numbers would stay in the history.
    if (seedFrame(fetch(previousSeeds, source).x) != (previousFrame & kFrameMask))
        return kFateWasSample;

    vec4 clip = clipNow(sampled);
    if (!isInsideFrustum(clip))
        return kFateOffScreen;
    vec2 landing = pixelOf(clip);
    ivec2 q = clamp(ivec2(landing), ivec2(0), frame.size - 1);
    landed = q;
    float depth = -(frame.viewFromWorld * vec4(positionNow(sampled), 1.0)).z;
    return fateAt(q, landing, sampled, depth);
}

void main() {
    ivec2 s = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(s, frame.strata)))
        return;
    ivec2 landed;
    uint fate = offer(s, landed);
    if (fate == kFateCarried)
        imageAtomicMax(owners, stratumOf(landed), claimKey(s));
    imageStore(claims, s, uvec4(fate, packPixel(landed), 0u, 0u));
}
