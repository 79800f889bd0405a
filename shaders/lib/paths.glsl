// SPDX-License-Identifier: MIT
// Functions that the steps of a path share: docs/pipeline.md, "Paths". PATH_DIVISION selects the
// signals that the parts of the light form.

#include "lib/bsdf.glsl"
#include "lib/lights.glsl"
#include "lib/random.glsl"
#include "lib/ray_listing.glsl"

Uint4Buffer(materials);

// Light on its way to the eye, by the lobe of the visible surface that sends it there.
struct Lobes {
    vec3 diffuse, specular;
};

Bsdf bsdfOf(uint instance, vec3 normal, vec3 geometric, vec3 view, float least) {
    int material = int(instanceLinks(instance).y * kTexelsPerMaterial);
    vec4 base = uintBitsToFloat(fetchBuffer(materials, material));
    float roughness = uintBitsToFloat(fetchBuffer(materials, material + 1)).w;
    return makeBsdf(normal, geometric, view, base.rgb, base.w, roughness, least);
}

// Veach 1997, section 9.2: the balance heuristic.
float misWeight(float pdf, float other) {
    return pdf / max(pdf + other, 1e-30);
}

// The density of a light sample with respect to solid angle, seen along `direction`.
float lightDensity(float distanceSquared, vec3 direction, vec3 areaNormal, bool doubleSided,
                   float probability) {
    float facing = -dot(direction, areaNormal); // twice the area times the cosine
    facing = doubleSided ? abs(facing) : max(facing, 0.0);
    return facing > 0.0 ? 2.0 * probability * distanceSquared / facing : 0.0;
}

// The light of one point of the area lights, sent to the viewer, and the ray that it comes along.
// With `mis` it is weighted against the directions of the surface.
Lobes sampleDirect(Bsdf b, vec3 origin, vec3 u, bool mis, out Ray ray) {
    ray = kNoRay;
    Lobes sent = Lobes(vec3(0.0), vec3(0.0));
    if (frame.lightTriangleCount == 0u)
        return sent;
    LightSample light = sampleLights(u, int(frame.lightTriangleCount));
    vec3 toLight = light.point - origin;
    float distanceSquared = max(dot(toLight, toLight), 1e-20);
    float distance = sqrt(distanceSquared);
    vec3 direction = toLight / distance;
    float density = lightDensity(distanceSquared, direction, light.areaNormal, light.doubleSided,
                                 light.probability);
    Scattering s = scatter(b, direction);
    if (density <= 0.0 || s.pdf <= 0.0)
        return sent;
    vec3 arriving = light.emission *
                    (dot(b.normal, direction) / density * (mis ? misWeight(density, s.pdf) : 1.0));
    sent = Lobes(s.diffuse * arriving, s.specular * arriving);
    bool matters = luminance(sent.diffuse + sent.specular) > 0.0;
    ray = Ray(origin, direction, matters ? distance * kShadowEnd : -1.0);
    return sent;
}

// Returns the divisors of both signals; after the filter they are multiplied with the same.
void divisorsOf(Bsdf b, out vec3 first, out vec3 second) {
#if PATH_DIVISION == 1
    first = max(b.diffuse, vec3(kLeastDivisor));
    second = max(b.specular, vec3(kLeastDivisor));
#else
    first = second = max(b.diffuse + b.specular, vec3(kLeastDivisor));
#endif
}

// The signals of light by its lobes. `first` of the divisors is that of whole paths.
void signalsOf(Lobes light, vec3 first, vec3 second, out vec3 signal0, out vec3 signal1) {
#if PATH_DIVISION == 1
    signal0 = light.diffuse / first;
    signal1 = light.specular / second;
#else
    signal0 = (light.diffuse + light.specular) / first;
    signal1 = vec3(0.0);
#endif
}
