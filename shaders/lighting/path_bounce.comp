#version 450 core
// SPDX-License-Identifier: MIT

// The end of a path: what the second surface emits, and the light that it gets from one point on
// the area lights. One invocation a ray of the list of path_scatter.comp, whose hits are there;
// lists the shadow rays. Kaplanyan and Dachsbacher 2013, "Path Space Regularization for Holistic
// and Robust Light Transport": the second surface is no smoother than frame.regularization.

#include "lib/paths.glsl"
#include "shared/bvh.h"

layout(local_size_x = kSegmentSize, local_size_y = kSegmentSize) in;

Uint4Buffer(bounces);
UintBuffer(bounceCounts);
Uint4Buffer(hits);
UintTexture(seeds);
Float4Texture(weight0);
#if PATH_DIVISION == 1
Float4Texture(weight1);
#endif

layout(rgba32f) uniform image2D raw0;
// The light that is added to the signals where the shadow ray is not blocked.
writeonly uniform image2D pending0;
#if PATH_DIVISION == 1
layout(rgba32f) uniform image2D raw1;
writeonly uniform image2D pending1;
writeonly uniform image2D distances; // of the hits of specular rays, meters
#endif

struct Hit {
    uint instance, triangle;
    vec3 position, normal, geometric; // on the side of the ray
};

Hit hitAt(uvec4 found, vec3 direction) {
    vec2 b = uintBitsToFloat(found.zw);
    uvec3 vertex = triangleVertices(found.x, found.y);
    Affine m = instanceTransform(found.x, false);
    Triangle t = worldTriangle(vertex, m);
    vec3 geometric = normalize(cross(t.edge1, t.edge2));
    vec3 normal = shadingNormal(vertex, m, b);
    geometric = dot(geometric, direction) > 0.0 ? -geometric : geometric;
    normal = dot(normal, geometric) < 0.0 ? -normal : normal;
    return Hit(found.x, found.y, pointOn(t, b), normal, geometric);
}

// The radiance that a hit emits against the ray, weighted against the sampling of lights.
vec3 emittedBy(Hit hit, vec3 origin, vec3 direction, float pdf) {
    uvec4 links = instanceLinks(hit.instance);
    if (links.z == kNoLight)
        return uintBitsToFloat(fetchBuffer(materials, int(links.y * kTexelsPerMaterial) + 1)).rgb;
    LightSample light = lightAt(int(links.w + hit.triangle), vec2(0.0));
    if (!light.doubleSided && dot(direction, light.areaNormal) >= 0.0)
        return vec3(0.0);
    vec3 way = hit.position - origin;
    float density = lightDensity(dot(way, way), direction, light.areaNormal, light.doubleSided,
                                 light.probability);
    return light.emission * misWeight(pdf, density);
}

void main() {
    uint place = gl_LocalInvocationIndex;
    uint segment = segmentIndex();
    Ray ray = kNoRay;
    ivec2 p = ivec2(0);
    if (place < fetchBuffer(bounceCounts, int(segment)).x) {
        uint index = segment * kSegmentRays + place;
        vec3 origin = uintBitsToFloat(fetchBuffer(bounces, int(index * kTexelsPerRay)).xyz);
        uvec4 to = fetchBuffer(bounces, int(index * kTexelsPerRay) + 1);
        vec3 direction = uintBitsToFloat(to.xyz);
        p = unpackPixel(to.w);
        uvec4 found = fetchBuffer(hits, int(index));
        vec4 w0 = fetch(weight0, p);

        vec3 arriving = frame.ambient;
        vec3 sent = vec3(0.0); // by the second surface, if its light is not blocked
        float far = 4.0 * frame.extent;
        if (found.x != kBvhNoInstance) {
            Hit hit = hitAt(found, direction);
            far = length(hit.position - origin);
            arriving = emittedBy(hit, origin, direction, w0.a);
            uint seed = fetch(seeds, p).x;
            vec3 u = vec3(randomNumber(seed, kDimensionBounceLight),
                          randomNumber(seed, kDimensionBounceLight + 1u),
                          randomNumber(seed, kDimensionBounceLight + 2u));
            Bsdf b =
                bsdfOf(hit.instance, hit.normal, hit.geometric, -direction, frame.regularization);
            Lobes lobes = sampleDirect(b, offsetOrigin(hit.position, hit.geometric), u, false, ray);
            sent = lobes.diffuse + lobes.specular;
        }
        imageStore(raw0, p, imageLoad(raw0, p) + vec4(w0.rgb * arriving, 0.0));
        imageStore(pending0, p, vec4(w0.rgb * sent, 0.0));
#if PATH_DIVISION == 1
        vec4 w1 = fetch(weight1, p);
        imageStore(raw1, p, imageLoad(raw1, p) + vec4(w1.rgb * arriving, 0.0));
        imageStore(pending1, p, vec4(w1.rgb * sent, 0.0));
        if (w1.a > 0.0)
            imageStore(distances, p, vec4(far));
#endif
    }
    listRay(ray, p);
}
