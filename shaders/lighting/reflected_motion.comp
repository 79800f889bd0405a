#version 450 core
// SPDX-License-Identifier: MIT

// Computes the motion vectors of mirror images. A mirror image lies behind its
// mirror, as far as the mirrored thing in front of it, and moves as if it stood there. Zimmer et
// al. 2015, "Path-space Motion Estimation and Decomposition for Robust Animation Filtering", EGSR,
// in the simple form of one flat mirror; docs/pipeline.md tells the rule.

#include "lib/encoding.glsl"
#include "lib/fetch.glsl"
#include "lib/frame.glsl"
#include "lib/geometry.glsl"
#include "lib/view.glsl"
#include "shared/path.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;

Uint4Texture(visibility);
Uint4Texture(surface);
Float4Texture(guides);
Float4Texture(motion);
FloatTexture(distances); // of the hits of specular rays, meters; 0: none
Uint4Buffer(materials);

writeonly uniform image2D reflected; // as `motion`

bool standsStill(uint instance) {
    Affine now = instanceTransform(instance, false), before = instanceTransform(instance, true);
    return now.rows[0] == before.rows[0] && now.rows[1] == before.rows[1] &&
           now.rows[2] == before.rows[2];
}

float roughnessOf(uint instance) {
    int material = int(instanceLinks(instance).y * kTexelsPerMaterial);
    return uintBitsToFloat(fetchBuffer(materials, material + 1)).w;
}

// The mean distance to what is mirrored around p; 0 where nothing is, or the mirror is not flat.
float mirroredDistance(ivec2 p, uint instance, vec3 normal) {
    float sum = 0.0, count = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            ivec2 q = clamp(p + ivec2(x, y), ivec2(0), frame.size - 1);
            if (fetch(visibility, q).x != instance + 1u)
                continue;
            if (dot(fetch(guides, q).xyz, normal) < kFlatMirror)
                return 0.0;
            float d = fetch(distances, q).x;
            sum += d;
            count += d > 0.0 ? 1.0 : 0.0;
        }
    return count > 0.0 ? sum / count : 0.0;
}

vec4 reflectedMotion(ivec2 p) {
    vec4 own = fetch(motion, p);
    vec4 guide = fetch(guides, p);
    if (guide.w == 0.0 || own.w == 0.0)
        return own;
    uint instance = fetch(visibility, p).x - 1u;
    if (roughnessOf(instance) > kMirrorRoughness || !standsStill(instance))
        return own;
    float d = mirroredDistance(p, instance, guide.xyz);
    if (d <= 0.0)
        return own;
    uvec4 point = fetch(surface, p);
    vec3 position = uintBitsToFloat(point.xyz), geometric = octDecode(point.w);
    vec3 image = position + normalize(position - frame.cameraPosition) * d;

    // The ray to the image meets the mirror where it was seen.
    vec3 way = image - frame.previousCameraPosition;
    float t =
        dot(geometric, position - frame.previousCameraPosition) / min(dot(geometric, way), -1e-12);
    vec4 clip = clipOf(frame.previousClipFromWorld, image);
    if (t <= 0.0 || t > 1.0 || clip.w <= 0.0)
        return own;
    vec3 met = frame.previousCameraPosition + t * way;
    float depth = -(frame.previousViewFromWorld * vec4(met, 1.0)).z;
    vec4 now = clipOf(frame.clipFromWorld, image);
    return vec4(pixelOf(clip) - pixelOf(now), depth, 1.0);
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, frame.size)))
        return;
    imageStore(reflected, p, reflectedMotion(p));
}
