#version 450 core
// SPDX-License-Identifier: MIT

// The first light of a path: that of one point on the area lights, at the visible surface. Lists
// the shadow rays, and makes the signals what they are if nothing is in the way.

#include "lib/visible_point.glsl"

layout(local_size_x = kSegmentSize, local_size_y = kSegmentSize) in;

UintTexture(seeds);

writeonly uniform image2D raw0;
#if PATH_DIVISION != 0
writeonly uniform image2D raw1;
#endif

void main() {
    ivec2 p = segmentPixel();
    Ray ray = kNoRay;
    if (all(lessThan(p, sizeOf(seeds)))) {
        vec3 signal0 = vec3(0.0), signal1 = vec3(0.0);
        if (isSurface(p)) {
            uint seed = fetch(seeds, p).x;
            VisiblePoint x1 = visiblePoint(p, eyeOf(seed));
            vec3 u = vec3(randomNumber(seed, kDimensionLight), randomNumber(seed, kDimensionLightU),
                          randomNumber(seed, kDimensionLightV));
            vec3 first, second;
            divisorsOf(x1.bsdf, first, second);
            signalsOf(sampleDirect(x1.bsdf, x1.origin, u, true, ray), first, second, signal0,
                      signal1);
        }
        imageStore(raw0, p, vec4(signal0, 0.0));
#if PATH_DIVISION != 0
        imageStore(raw1, p, vec4(signal1, 0.0));
#endif
    }
    listRay(ray, p);
}
