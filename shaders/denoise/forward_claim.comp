#version 450 core

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

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;

Uint4Texture(previousVisibility);
UintTexture(previousSeeds);
Uint4Texture(visibility);
layout(r32ui) uniform uimage2D owners;

const float kDepthTolerance = 0.01; // of the sample's depth

const uint kFrameMask = (1u << 18) - 1u; // of a seed's frame

// Whether the surface seen at the landing pixel is the sample's: the same instance, and its
// triangle's plane, extended to the exact landing position, at the same depth.
bool isVisibleAt(ivec2 q, vec2 landing, uvec4 sampled, float depth) {
    uvec4 seen = fetch(visibility, q);
    if (seen.x != sampled.x)
        return false;
    Triangle t =
        worldTriangle(triangleVertices(seen.x - 1u, seen.y), instanceTransform(seen.x - 1u, false));
    vec3 normal = cross(t.edge1, t.edge2);
    vec3 direction = worldRay(landing);
    float along = dot(normal, direction);
    float planeDepth = dot(normal, t.corner - frame.cameraPosition) / along;
    float centerDepth = -(frame.viewFromWorld * vec4(pointOn(t, uintBitsToFloat(seen.zw)), 1.0)).z;
    bool edgeOn = abs(along) < 1e-3 * length(normal) * length(direction);
    float seenDepth = edgeOn ? centerDepth : planeDepth;
    return abs(seenDepth - depth) <= kDepthTolerance * depth;
}

void main() {
    ivec2 s = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(s, frame.strata)) || frame.historyValid == 0u)
        return;

    uint previousFrame = frame.frame - 1u;
    ivec2 source = candidatePixel(s, previousFrame);
    uvec4 sampled = fetch(previousVisibility, source);
    // A seed of an older frame marks a pixel that was a gradient sample itself: used for a second
    // time, its random numbers would stay in the history.
    if (sampled.x == 0u ||
        seedFrame(fetch(previousSeeds, source).x) != (previousFrame & kFrameMask))
        return;

    vec4 clip = clipNow(sampled);
    if (!isInsideFrustum(clip))
        return;
    vec2 landing = pixelOf(clip);
    ivec2 q = clamp(ivec2(landing), ivec2(0), frame.size - 1);
    float depth = -(frame.viewFromWorld * vec4(positionNow(sampled), 1.0)).z;
    if (isVisibleAt(q, landing, sampled, depth))
        imageAtomicMax(owners, stratumOf(q), claimKey(s));
}
