// SPDX-License-Identifier: MIT
// A random point on the area lights. Schied et al. 2018, section 5: one random number picks the
// light, two pick the point on it.

#include "lib/fetch.glsl"
#include "lib/geometry.glsl"

Uint4Buffer(lightTriangles);
Uint4Buffer(lightScales); // rgb, per slot: what the user made of the light; 1 is nominal

struct LightSample {
    vec3 point;
    vec3 areaNormal;   // twice the area long; out of the emitting side
    vec3 emission;     // radiance as it is now
    float probability; // of the triangle
    bool doubleSided;
};

// The point of a light triangle with these barycentric weights of vertices 1 and 2.
LightSample lightAt(int triangle, vec2 weights) {
    int first = triangle * int(kTexelsPerLightTriangle);
    vec3 corner = uintBitsToFloat(fetchBuffer(lightTriangles, first)).xyz;
    vec4 edge1 = uintBitsToFloat(fetchBuffer(lightTriangles, first + 1));
    uvec4 edge2 = fetchBuffer(lightTriangles, first + 2);
    uvec4 emitted = fetchBuffer(lightTriangles, first + 3);
    vec3 e2 = uintBitsToFloat(edge2).xyz;
    LightSample light;
    light.point = corner + weights.x * edge1.xyz + weights.y * e2;
    light.areaNormal = cross(edge1.xyz, e2);
    light.emission =
        uintBitsToFloat(emitted).rgb * uintBitsToFloat(fetchBuffer(lightScales, int(edge2.w))).rgb;
    light.probability = edge1.w;
    light.doubleSided = emitted.w != 0u;
    return light;
}

// The first triangle whose cumulative probability exceeds u. Nominal powers make the distribution,
// so a toggled light changes nobody's pick.
int pickLightTriangle(float u, int count) {
    int low = 0, high = count - 1;
    while (low < high) {
        int middle = (low + high) / 2;
        if (uintBitsToFloat(fetchBuffer(lightTriangles, middle * int(kTexelsPerLightTriangle))).w >
            u)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

LightSample sampleLights(vec3 u, int count) {
    // Uniform over the triangle; Turk 1990.
    float root = sqrt(u.y);
    return lightAt(pickLightTriangle(u.x, count), vec2(root * (1.0 - u.z), root * u.z));
}
