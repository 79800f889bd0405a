// SPDX-License-Identifier: MIT
// The first point of a path: the surface that a pixel shows, and how it scatters light to the eye.

#include "lib/encoding.glsl"
#include "lib/paths.glsl"

Uint4Texture(visibility);
Uint4Texture(surface);
Float4Texture(guides);

struct VisiblePoint {
    Bsdf bsdf;
    vec3 origin; // of rays
    uint instance;
};

bool isSurface(ivec2 p) {
    return fetch(guides, p).w != 0.0;
}

VisiblePoint visiblePoint(ivec2 p, vec3 eye) {
    uvec4 point = fetch(surface, p);
    vec3 position = uintBitsToFloat(point.xyz), geometric = octDecode(point.w);
    uint instance = fetch(visibility, p).x - 1u;
    Bsdf bsdf = bsdfOf(instance, fetch(guides, p).xyz, geometric, normalize(eye - position), 0.0);
    return VisiblePoint(bsdf, offsetOrigin(position, geometric), instance);
}

// Returns the eye of a pixel's sample. A gradient sample, whose seed is that of the frame before,
// is shaded as it was then: a change of view is no change of light.
vec3 eyeOf(uint seed) {
    bool isCarried = seedFrame(seed) != (frame.sampleIndex & (0xffffffffu >> (2 * kTileBits)));
    return isCarried ? frame.previousCameraPosition : frame.cameraPosition;
}
