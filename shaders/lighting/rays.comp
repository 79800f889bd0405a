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
#include "lib/encoding.glsl"
#include "lib/lights.glsl"
#include "lib/random.glsl"
#include "lib/ray_listing.glsl"
#include "lib/tangent.glsl"

layout(local_size_x = kSegmentSize, local_size_y = kSegmentSize) in;

Uint4Texture(visibility);
Uint4Texture(surface);
Float4Texture(guides);
UintTexture(seeds);

#ifdef FIRST
writeonly uniform image2D raw;
#endif

const float kPi = 3.14159265358979;

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
    Ray ray = kNoRay;
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

void main() {
    ivec2 p = segmentPixel();
    Ray ray = kNoRay;
    if (all(lessThan(p, sizeOf(seeds))))
        ray = rayOf(p);
    listRay(ray, p);
}
