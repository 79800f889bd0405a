#version 450 core
// SPDX-License-Identifier: MIT

// Lists rays of kinds that no frame traces: with PRIMARY those from the camera through the centers
// of pixels, with BOUNCE one into the hemisphere above the surface of each pixel, with
// BOUNCE_SHADOW one from each hit of those to a random point of the area lights. The list is laid
// out as that of lighting/rays.comp.

#include "lib/encoding.glsl"
#include "lib/fetch.glsl"
#include "lib/frame.glsl"
#include "lib/geometry.glsl"
#include "lib/hash.glsl"
#include "lib/lights.glsl"
#include "lib/tile.glsl"
#include "lib/view.glsl"
#include "shared/bvh.h"
#include "shared/ray_list.h"

layout(local_size_x = kSegmentSize, local_size_y = kSegmentSize) in;

#ifdef BOUNCE
Uint4Texture(surface);
Float4Texture(guides);
#endif
#ifdef BOUNCE_SHADOW
Uint4Buffer(bounces); // rays, their number a segment, and their hits (bench/trace.comp)
UintBuffer(bounceCounts);
Uint4Buffer(bounceHits);
#endif

writeonly uniform uimageBuffer rays;
writeonly uniform uimageBuffer rayCounts;

const float kPi = 3.14159265358979;
const float kFar = 1e30;         // of rays that end nowhere
const float kShadowEnd = 0.9995; // a shadow ray ends before the light that it goes to
const float kOffset = 2e-5;      // of an origin from its surface, in extents of the scene

struct Ray {
    vec3 origin, direction;
    float tMax; // below 0: it is not listed
    ivec2 pixel;
};

const Ray kNoRay = Ray(vec3(0.0), vec3(0.0), -1.0, ivec2(0));

// A number in [0, 1) of a pixel.
float numberOf(ivec2 p, uint dimension) {
    uint bits = hash3(frame.seed, uint(p.x) | (uint(p.y) << 16u), dimension);
    return float(bits >> 8) * (1.0 / 16777216.0);
}

#ifdef PRIMARY
Ray makeRay() {
    ivec2 p = segmentPixel();
    if (any(greaterThanEqual(p, frame.size)))
        return kNoRay;
    return Ray(frame.cameraPosition, normalize(worldRay(vec2(p) + 0.5)), kFar, p);
}
#endif

#ifdef BOUNCE
// Cosine-weighted. The tangent: Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
Ray makeRay() {
    ivec2 p = segmentPixel();
    if (any(greaterThanEqual(p, frame.size)))
        return kNoRay;
    vec4 guide = fetch(guides, p);
    if (guide.w == 0.0)
        return kNoRay;
    uvec4 point = fetch(surface, p);
    vec3 n = guide.xyz, geometricNormal = octDecode(point.w);
    float side = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (side + n.z);
    vec3 tangent = vec3(1.0 + side * n.x * n.x * a, side * n.x * n.y * a, -side * n.x);
    float radius = sqrt(numberOf(p, 0u)), angle = 2.0 * kPi * numberOf(p, 1u);
    vec3 direction = radius * cos(angle) * tangent + radius * sin(angle) * cross(n, tangent) +
                     sqrt(max(0.0, 1.0 - radius * radius)) * n;
    vec3 origin = uintBitsToFloat(point.xyz) + geometricNormal * (kOffset * frame.extent);
    return Ray(origin, direction, dot(direction, geometricNormal) > 0.0 ? kFar : -1.0, p);
}
#endif

#ifdef BOUNCE_SHADOW
Ray makeRay() {
    uint segment = segmentIndex();
    if (gl_LocalInvocationIndex >= fetchBuffer(bounceCounts, int(segment)).x ||
        frame.lightTriangleCount == 0u)
        return kNoRay;
    int place = int(segment * kSegmentRays + gl_LocalInvocationIndex);
    uvec4 hit = fetchBuffer(bounceHits, place);
    if (hit.y == kBvhNoInstance)
        return kNoRay;
    vec3 from = uintBitsToFloat(fetchBuffer(bounces, place * int(kTexelsPerRay)).xyz);
    uvec4 to = fetchBuffer(bounces, place * int(kTexelsPerRay) + 1);
    vec3 incoming = uintBitsToFloat(to.xyz);
    ivec2 p = ivec2(to.w & 0xffffu, to.w >> 16u);

    Triangle t = worldTriangle(triangleVertices(hit.y, hit.z), instanceTransform(hit.y, false));
    vec3 across = cross(t.edge1, t.edge2);
    vec3 normal = across / max(length(across), 1e-20);
    normal = dot(normal, incoming) > 0.0 ? -normal : normal;
    vec3 origin = from + uintBitsToFloat(hit.x) * incoming + normal * (kOffset * frame.extent);

    vec3 u = vec3(numberOf(p, 2u), numberOf(p, 3u), numberOf(p, 4u));
    LightSample light = sampleLights(u, int(frame.lightTriangleCount));
    vec3 toLight = light.point - origin;
    float distance = length(toLight);
    vec3 direction = toLight / max(distance, 1e-20);
    float facing = -dot(direction, light.areaNormal);
    facing = light.doubleSided ? abs(facing) : facing;
    bool shines = any(greaterThan(light.emission, vec3(0.0)));
    bool matters = shines && dot(direction, normal) > 0.0 && facing > 0.0;
    return Ray(origin, direction, matters ? distance * kShadowEnd : -1.0, p);
}
#endif

shared uint listed[kSegmentRays / 32u]; // a bit for each invocation whose ray is listed

void main() {
    uint lane = gl_LocalInvocationIndex;
    if (lane < kSegmentRays / 32u)
        listed[lane] = 0u;
    memoryBarrierShared();
    barrier();

    Ray ray = makeRay();
    bool matters = ray.tMax > 0.0;
    uint word = lane >> 5u, bit = 1u << (lane & 31u);
    if (matters)
        atomicOr(listed[word], bit);
    memoryBarrierShared();
    barrier();

    uint before = 0u, all = 0u;
    for (uint i = 0u; i < kSegmentRays / 32u; ++i) {
        uint bits = listed[i];
        before += uint(bitCount(i < word ? bits : (i == word ? bits & (bit - 1u) : 0u)));
        all += uint(bitCount(bits));
    }
    uint segment = segmentIndex();
    if (matters) {
        int texel = int((segment * kSegmentRays + before) * kTexelsPerRay);
        imageStore(rays, texel, floatBitsToUint(vec4(ray.origin, ray.tMax)));
        imageStore(
            rays, texel + 1,
            uvec4(floatBitsToUint(ray.direction), uint(ray.pixel.x) | (uint(ray.pixel.y) << 16u)));
    }
    if (lane == 0u)
        imageStore(rayCounts, int(segment), uvec4(all, 0u, 0u, 0u));
}
