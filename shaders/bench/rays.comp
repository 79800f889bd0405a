#version 450 core
// SPDX-License-Identifier: MIT

// Lists rays of every signal's kinds, whatever the signal and the materials: with PRIMARY those
// from the camera through the centers of pixels, with BOUNCE one into the hemisphere above the
// surface of each pixel, with BOUNCE_SHADOW one from each hit of those to a random point of the
// area lights.

#include "lib/encoding.glsl"
#include "lib/hash.glsl"
#include "lib/lights.glsl"
#include "lib/ray_listing.glsl"
#include "lib/tangent.glsl"
#include "lib/view.glsl"
#include "shared/bvh.h"

layout(local_size_x = kSegmentSize, local_size_y = kSegmentSize) in;

#ifdef BOUNCE
Uint4Texture(visibility);
Uint4Texture(surface);
Float4Texture(guides);
#endif
#ifdef BOUNCE_SHADOW
Uint4Buffer(bounces); // rays, their number a segment, and their hits (lighting/trace_closest.comp)
UintBuffer(bounceCounts);
Uint4Buffer(bounceHits);
#endif

const float kPi = 3.14159265358979;

// A number in [0, 1) of a pixel.
float numberOf(ivec2 p, uint dimension) {
    uint bits = hash3(frame.seed, packPixel(p), dimension);
    return float(bits >> 8) * (1.0 / 16777216.0);
}

#ifdef PRIMARY
Ray makeRay(ivec2 p) {
    if (any(greaterThanEqual(p, frame.size)))
        return kNoRay;
    return Ray(frame.cameraPosition, normalize(worldRay(vec2(p) + 0.5)), kFar);
}
#endif

#ifdef BOUNCE
// Cosine-weighted.
Ray makeRay(ivec2 p) {
    if (any(greaterThanEqual(p, frame.size)))
        return kNoRay;
    vec4 guide = fetch(guides, p);
    if (guide.w == 0.0)
        return kNoRay;
    uvec4 point = fetch(surface, p);
    vec3 n = guide.xyz, geometricNormal = octDecode(point.w);
    vec3 tangent = tangentOf(n, fetch(visibility, p).x - 1u);
    float radius = sqrt(numberOf(p, 0u)), angle = 2.0 * kPi * numberOf(p, 1u);
    vec3 direction = radius * cos(angle) * tangent + radius * sin(angle) * cross(n, tangent) +
                     sqrt(max(0.0, 1.0 - radius * radius)) * n;
    vec3 origin = offsetOrigin(uintBitsToFloat(point.xyz), geometricNormal);
    return Ray(origin, direction, dot(direction, geometricNormal) > 0.0 ? kFar : -1.0);
}
#endif

#ifdef BOUNCE_SHADOW
Ray makeRay(inout ivec2 p) {
    uint segment = segmentIndex();
    if (gl_LocalInvocationIndex >= fetchBuffer(bounceCounts, int(segment)).x ||
        frame.lightTriangleCount == 0u)
        return kNoRay;
    int place = int(segment * kSegmentRays + gl_LocalInvocationIndex);
    uvec4 hit = fetchBuffer(bounceHits, place);
    if (hit.x == kBvhNoInstance)
        return kNoRay;
    uvec4 to = fetchBuffer(bounces, place * int(kTexelsPerRay) + 1);
    vec3 incoming = uintBitsToFloat(to.xyz);
    p = unpackPixel(to.w);

    Triangle t = worldTriangle(triangleVertices(hit.x, hit.y), instanceTransform(hit.x, false));
    vec3 across = cross(t.edge1, t.edge2);
    vec3 normal = across / max(length(across), 1e-20);
    normal = dot(normal, incoming) > 0.0 ? -normal : normal;
    vec3 origin = offsetOrigin(pointOn(t, uintBitsToFloat(hit.zw)), normal);

    vec3 u = vec3(numberOf(p, 2u), numberOf(p, 3u), numberOf(p, 4u));
    LightSample light = sampleLights(u, int(frame.lightTriangleCount));
    vec3 toLight = light.point - origin;
    float distance = length(toLight);
    vec3 direction = toLight / max(distance, 1e-20);
    float facing = -dot(direction, light.areaNormal);
    facing = light.doubleSided ? abs(facing) : facing;
    bool shines = any(greaterThan(light.emission, vec3(0.0)));
    bool matters = shines && dot(direction, normal) > 0.0 && facing > 0.0;
    return Ray(origin, direction, matters ? distance * kShadowEnd : -1.0);
}
#endif

void main() {
    ivec2 p = segmentPixel();
    Ray ray = makeRay(p);
    listRay(ray, p);
}
