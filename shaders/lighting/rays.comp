#version 450 core
// SPDX-License-Identifier: MIT

// The ray of each pixel's sample: with SHADOWS one to a random point of the area lights, with
// AMBIENT_OCCLUSION one into the hemisphere. Schied et al. 2018, section 5. Every value depends on
// the surface point, the seed and the lights, and not on the camera: shaded again with its seed in
// the next frame, an unchanged point has an unchanged value, bit for bit.
//
// Rays that cannot change the picture are not listed: those of surfaces that face away from their
// light, say. With SHADOWS, `raw` becomes the light that arrives if nothing is in the way; with
// FIRST, it begins with none.

#include "lib/color.glsl"
#include "lib/counters.glsl"
#include "lib/encoding.glsl"
#include "lib/fetch.glsl"
#include "lib/frame.glsl"
#include "lib/geometry.glsl"
#include "lib/lights.glsl"
#include "lib/random.glsl"
#include "lib/tile.glsl"
#include "shared/ray_list.h"

layout(local_size_x = kSegmentSize, local_size_y = kSegmentSize) in;

Uint4Texture(visibility);
Uint4Texture(surface);
Float4Texture(guides);
UintTexture(seeds);

#ifdef FIRST
writeonly uniform image2D raw;
#endif
writeonly uniform uimageBuffer rays;
writeonly uniform uimageBuffer rayCounts;

const float kPi = 3.14159265358979;
// Where the tangent jumps: between no normals that are common, since rounding would then turn it
// over from one frame to the next on a body that moves.
const float kBasisTurns = -0.7;
const float kShadowEnd = 0.9995; // a shadow ray ends before the light that it goes to

struct Ray {
    vec3 origin, direction;
    float tMax; // below 0: it does not matter
};

// Rays start off the surface by a fraction of the scene, so that they do not hit where they come
// from.
vec3 offsetOrigin(vec3 position, vec3 geometricNormal) {
    return position + geometricNormal * (2e-5 * frame.extent);
}

#ifdef SHADOWS
// Radiance reflected by a white Lambertian surface: 1/pi of the irradiance, estimated from one
// point, and the ray that it comes along.
vec3 directLight(vec3 origin, vec3 normal, vec3 geometricNormal, uint seed, out Ray ray) {
    ray = Ray(origin, vec3(0.0), -1.0);
    if (frame.lightTriangleCount == 0u)
        return vec3(0.0);
    vec3 u = vec3(randomNumber(seed, kDimensionLight), randomNumber(seed, kDimensionLightU),
                  randomNumber(seed, kDimensionLightV));
    LightSample light = sampleLights(u, int(frame.lightTriangleCount));
    vec3 toLight = light.point - origin;
    float distanceSquared = dot(toLight, toLight);
    float distance = sqrt(distanceSquared);
    vec3 direction = toLight / max(distance, 1e-20);

    float cosine = dot(geometricNormal, direction) > 0.0 ? max(dot(normal, direction), 0.0) : 0.0;
    float facing = -dot(direction, light.areaNormal);
    facing = light.doubleSided ? abs(facing) : max(facing, 0.0);
    // Half of areaNormal's length is the area, and 1 / area the density on it.
    vec3 value = light.emission *
                 (cosine * 0.5 * facing / (kPi * max(distanceSquared, 1e-20) * light.probability));
    ray.direction = direction;
    ray.tMax = luminance(value) > 0.0 ? distance * kShadowEnd : -1.0;
    return value;
}
#endif

#ifdef AMBIENT_OCCLUSION
// A tangent that turns with the instance, so that a reused random number means the same direction
// on a body that has moved. Duff et al. 2017, "Building an Orthonormal Basis, Revisited", in object
// space.
vec3 tangentOf(vec3 normal, uint instance) {
    Affine m = instanceTransform(instance, false);
    vec3 n =
        normalize(normal.x * m.rows[0].xyz + normal.y * m.rows[1].xyz + normal.z * m.rows[2].xyz);
    float side = n.z >= kBasisTurns ? 1.0 : -1.0;
    float a = -1.0 / (side + n.z);
    vec3 t = vec3(1.0 + side * n.x * n.x * a, side * n.x * n.y * a, -side * n.x);
    vec3 world = vec3(dot(m.rows[0].xyz, t), dot(m.rows[1].xyz, t), dot(m.rows[2].xyz, t));
    return normalize(world - dot(world, normal) * normal);
}

// A cosine-weighted ray: what it does not hit within the radius is the uniform surroundings.
Ray ambientRay(vec3 origin, vec3 normal, vec3 geometricNormal, vec3 tangent, uint seed) {
    float radius = sqrt(randomNumber(seed, kDimensionAoU));
    float angle = 2.0 * kPi * randomNumber(seed, kDimensionAoV);
    vec3 direction = radius * cos(angle) * tangent + radius * sin(angle) * cross(normal, tangent) +
                     sqrt(max(0.0, 1.0 - radius * radius)) * normal;
    bool above = dot(direction, geometricNormal) > 0.0;
    return Ray(origin, direction, above ? frame.aoRadius : -1.0);
}
#endif

// The ray of a pixel; also makes `raw` what it is before any ray is traced.
Ray rayOf(ivec2 p) {
    vec4 guide = fetch(guides, p);
    Ray ray = Ray(vec3(0.0), vec3(0.0), -1.0);
    vec3 unshadowed = vec3(0.0);
    if (guide.w != 0.0) {
        uvec4 point = fetch(surface, p);
        uint seed = fetch(seeds, p).x;
        vec3 geometricNormal = octDecode(point.w);
        vec3 origin = offsetOrigin(uintBitsToFloat(point.xyz), geometricNormal);
#ifdef SHADOWS
        unshadowed = directLight(origin, guide.xyz, geometricNormal, seed, ray);
#endif
#ifdef AMBIENT_OCCLUSION
        vec3 tangent = tangentOf(guide.xyz, fetch(visibility, p).x - 1u);
        ray = ambientRay(origin, guide.xyz, geometricNormal, tangent, seed);
#endif
    }
#ifdef FIRST
    imageStore(raw, p, vec4(unshadowed, 0.0));
#endif
    return ray;
}

shared uint listed[kSegmentWords]; // a bit for each invocation whose ray matters

void main() {
    uint lane = gl_LocalInvocationIndex;
    if (lane < kSegmentWords)
        listed[lane] = 0u;
    memoryBarrierShared();
    barrier();

    ivec2 p = segmentPixel();
    Ray ray = Ray(vec3(0.0), vec3(0.0), -1.0);
    if (all(lessThan(p, sizeOf(seeds))))
        ray = rayOf(p);
    bool matters = ray.tMax > 0.0;
    uint word = lane >> 5u, bit = 1u << (lane & 31u);
    if (matters)
        atomicOr(listed[word], bit);
    memoryBarrierShared();
    barrier();

    uint before = 0u, all = 0u;
    for (uint i = 0u; i < kSegmentWords; ++i) {
        uint bits = listed[i];
        before += uint(bitCount(i < word ? bits : (i == word ? bits & (bit - 1u) : 0u)));
        all += uint(bitCount(bits));
    }
    uint segment = segmentIndex();
    if (matters) {
        int texel = int((segment * kSegmentRays + before) * kTexelsPerRay);
        imageStore(rays, texel, floatBitsToUint(vec4(ray.origin, ray.tMax)));
        imageStore(rays, texel + 1,
                   uvec4(floatBitsToUint(ray.direction), uint(p.x) | (uint(p.y) << 16u)));
    }
    if (lane == 0u) {
        imageStore(rayCounts, int(segment), uvec4(all, 0u, 0u, 0u));
        count(kCounterRays, all);
    }
}
