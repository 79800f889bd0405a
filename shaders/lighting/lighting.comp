#version 450 core
// SPDX-License-Identifier: MIT

// One sample per pixel of the demodulated signal: a shadow ray to a random point of the area
// lights, an ambient occlusion ray, or both. Schied et al. 2018, section 5. Every value depends on
// the surface point, the seed and the lights, and not on the camera: shaded again with its seed in
// the next frame, an unchanged point has an unchanged value, bit for bit.
//
// SHADOWS and AMBIENT_OCCLUSION say which rays are traced.

#include "lib/color.glsl"
#include "lib/counters.glsl"
#include "lib/encoding.glsl"
#include "lib/fetch.glsl"
#include "lib/frame.glsl"
#include "lib/geometry.glsl"
#include "lib/lights.glsl"
#include "lib/random.glsl"
#include "lib/tile.glsl"

#include "lib/bvh_trace.glsl" // after the frame block, which has its parameters

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;

Uint4Texture(visibility);
Uint4Texture(surface);
Float4Texture(guides);
UintTexture(seeds);

writeonly uniform image2D raw;

const float kPi = 3.14159265358979;
// Where the tangent jumps: between no normals that are common, since rounding would then turn it
// over from one frame to the next on a body that moves.
const float kBasisTurns = -0.7;
const float kShadowEnd = 0.9995; // a shadow ray ends before the light that it goes to

shared uint raysOfGroup;

// Rays start off the surface by a fraction of the scene, so that they do not hit where they come
// from.
vec3 offsetOrigin(vec3 position, vec3 geometricNormal) {
    return position + geometricNormal * (2e-5 * frame.extent);
}

// Radiance reflected by a white Lambertian surface: 1/pi of the irradiance, estimated from one
// point.
vec3 directLight(vec3 origin, vec3 normal, vec3 geometricNormal, uint seed, inout uint rays) {
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

    bool matters = luminance(value) > 0.0;
    rays += matters ? 1u : 0u;
    return occluded(origin, direction, matters ? distance * kShadowEnd : -1.0) ? vec3(0.0) : value;
}

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
vec3 ambientLight(vec3 origin, vec3 normal, vec3 geometricNormal, vec3 tangent, uint seed,
                  inout uint rays) {
    float radius = sqrt(randomNumber(seed, kDimensionAoU));
    float angle = 2.0 * kPi * randomNumber(seed, kDimensionAoV);
    vec3 direction = radius * cos(angle) * tangent + radius * sin(angle) * cross(normal, tangent) +
                     sqrt(max(0.0, 1.0 - radius * radius)) * normal;
    bool above = dot(direction, geometricNormal) > 0.0;
    rays += above ? 1u : 0u;
    bool hidden = occluded(origin, direction, above ? frame.aoRadius : -1.0);
    return above && !hidden ? frame.ambient : vec3(0.0);
}

void shade(ivec2 p, inout uint rays) {
    vec4 guide = fetch(guides, p);
    if (guide.w == 0.0) {
        imageStore(raw, p, vec4(0.0));
        return;
    }
    uvec4 point = fetch(surface, p);
    uint seed = fetch(seeds, p).x;
    vec3 geometricNormal = octDecode(point.w);
    vec3 origin = offsetOrigin(uintBitsToFloat(point.xyz), geometricNormal);

    vec3 signal = vec3(0.0);
#ifdef SHADOWS
    signal += directLight(origin, guide.xyz, geometricNormal, seed, rays);
#endif
#ifdef AMBIENT_OCCLUSION
    vec3 tangent = tangentOf(guide.xyz, fetch(visibility, p).x - 1u);
    signal += ambientLight(origin, guide.xyz, geometricNormal, tangent, seed, rays);
#endif
    if (any(isnan(signal)) || any(isinf(signal))) {
        count(kCounterInvalid, 1u);
        signal = vec3(0.0);
    }
    // Bounded once, here, before the gradient and the filter alike.
    signal = clamp(signal, vec3(0.0), vec3(frame.signalClamp));
    imageStore(raw, p, vec4(signal, luminance(signal)));
}

void main() {
    if (gl_LocalInvocationIndex == 0u)
        raysOfGroup = 0u;
    memoryBarrierShared();
    barrier();

    ivec2 p = tilePixel();
    uint rays = 0u;
    if (all(lessThan(p, sizeOf(seeds))))
        shade(p, rays);
    atomicAdd(raysOfGroup, rays);

    memoryBarrierShared();
    barrier();
    if (gl_LocalInvocationIndex == 0u)
        count(kCounterRays, raysOfGroup);
}
