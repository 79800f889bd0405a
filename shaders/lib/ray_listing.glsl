// SPDX-License-Identifier: MIT
// Lists the rays of a workgroup of kSegmentRays invocations without gaps: shared/ray_list.h.

#include "lib/counters.glsl"
#include "lib/encoding.glsl"
#include "lib/frame.glsl"
#include "lib/tile.glsl"

writeonly uniform uimageBuffer rays;
writeonly uniform uimageBuffer rayCounts;

struct Ray {
    vec3 origin, direction;
    float tMax; // not above 0: it does not matter
};

const Ray kNoRay = Ray(vec3(0.0), vec3(0.0), -1.0);
const float kFar = 1e30;         // of rays that end nowhere
const float kShadowEnd = 0.9995; // a shadow ray ends before the light that it goes to

// Rays start off the surface by a fraction of the scene, so that they do not hit where they come
// from.
vec3 offsetOrigin(vec3 position, vec3 geometricNormal) {
    return position + geometricNormal * (2e-5 * frame.extent);
}

shared uint listed[kSegmentWords]; // a bit for each invocation whose ray matters

// Every invocation of the workgroup calls it, once.
void listRay(Ray ray, ivec2 pixel) {
    uint lane = gl_LocalInvocationIndex;
    if (lane < kSegmentWords)
        listed[lane] = 0u;
    memoryBarrierShared();
    barrier();
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
        imageStore(rays, texel + 1, uvec4(floatBitsToUint(ray.direction), packPixel(pixel)));
    }
    if (lane == 0u) {
        imageStore(rayCounts, int(segment), uvec4(all, 0u, 0u, 0u));
        count(kCounterRays, all);
    }
}
