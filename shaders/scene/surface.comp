#version 450 core
// SPDX-License-Identifier: MIT

// The surface behind each visibility sample: where it is, where it was one frame ago, what it is
// made of.

#include "lib/encoding.glsl"
#include "lib/frame.glsl"
#include "lib/geometry.glsl"
#include "lib/view.glsl"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;

Uint4Texture(visibility);
Uint4Buffer(materials);
Uint4Buffer(lightScales); // rgb, per slot: what the user made of the light; 1 is nominal

writeonly uniform uimage2D surface;
writeonly uniform image2D guides, slope, motion, albedo, emission;

// Change of depth per pixel along the tangent plane. On a plane n . X = d and along the view ray
// X = z r, hence 1/z = (n . r) / d is linear in the picture.
vec2 depthSlope(vec3 viewPosition, vec3 viewNormal) {
    float z = -viewPosition.z;
    float d = dot(viewNormal, viewPosition);
    vec2 rayStep = 2.0 * frame.tanHalfFov / float(frame.size.y) * vec2(1.0, -1.0);
    vec2 slopes = -z * z * viewNormal.xy * rayStep / (abs(d) > 1e-12 ? d : 1e-12);
    return clamp(slopes, -z, z); // seen edge-on the plane's slope has no bound
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, sizeOf(visibility))))
        return;
    uvec4 sampled = fetch(visibility, p);
    // Background is computed as if it showed the first triangle, and stored as 0: one set of
    // stores.
    bool isSurface = sampled.x != 0u;
    uint instance = max(sampled.x, 1u) - 1u;
    vec2 b = uintBitsToFloat(sampled.zw);
    uvec3 vertex = triangleVertices(instance, sampled.y);
    Affine now = instanceTransform(instance, false);
    Triangle t = worldTriangle(vertex, now);
    vec3 position = pointOn(t, b);
    vec3 before = pointOn(worldTriangle(vertex, instanceTransform(instance, true)), b);

    vec3 geometric = normalize(cross(t.edge1, t.edge2));
    vec3 normal = shadingNormal(vertex, now, b);
    vec3 toCamera = frame.cameraPosition - position;
    geometric = dot(geometric, toCamera) < 0.0 ? -geometric : geometric;
    normal = dot(normal, geometric) < 0.0 ? -normal : normal;

    vec3 viewPosition = (frame.viewFromWorld * vec4(position, 1.0)).xyz;
    float depth = -viewPosition.z;
    vec4 clip = clipOf(frame.clipFromWorld, position);
    vec4 previousClip = clipOf(frame.previousClipFromWorld, before);
    float previousDepth = -(frame.previousViewFromWorld * vec4(before, 1.0)).z;
    bool wasInFront = previousClip.w > 0.0;
    // Where nothing moves it is 0, not nearly 0: see transformPoint().
    precise vec2 moved = wasInFront ? pixelOf(previousClip) - pixelOf(clip) : vec2(0.0);

    uvec4 links = instanceLinks(instance);
    int material = int(links.y * kTexelsPerMaterial);
    vec4 base = uintBitsToFloat(fetchBuffer(materials, material));
    vec4 emitted = uintBitsToFloat(fetchBuffer(materials, material + 1));
    vec3 scale = links.z == kNoLight ? vec3(1.0)
                                     : uintBitsToFloat(fetchBuffer(lightScales, int(links.z))).rgb;

    vec2 slopes = depthSlope(viewPosition, mat3(frame.viewFromWorld) * geometric);
    uvec4 place = uvec4(floatBitsToUint(position), octEncode(geometric));
    imageStore(surface, p, isSurface ? place : uvec4(0u));
    imageStore(guides, p, isSurface ? vec4(normal, depth) : vec4(0.0));
    imageStore(slope, p, isSurface ? vec4(slopes, 0.0, 0.0) : vec4(0.0));
    imageStore(motion, p,
               isSurface ? vec4(moved, previousDepth, wasInFront ? 1.0 : 0.0) : vec4(0.0));
    imageStore(albedo, p, isSurface ? vec4(base.rgb, 1.0) : vec4(0.0));
    imageStore(emission, p, isSurface ? vec4(emitted.rgb * scale, 1.0) : vec4(0.0));
}
