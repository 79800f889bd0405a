#version 450 core
// SPDX-License-Identifier: MIT

// The second segment of a path: lists the ray along which the visible surface looks for light, and
// keeps what of it reaches the eye.

#include "lib/tangent.glsl"
#include "lib/visible_point.glsl"

layout(local_size_x = kSegmentSize, local_size_y = kSegmentSize) in;

UintTexture(seeds);

writeonly uniform image2D weight0; // rgb: of the signal, a change per radiance; a: density, 1/sr
#if PATH_DIVISION == 1
writeonly uniform image2D weight1; // a: 1 if the direction is of the specular lobe
writeonly uniform image2D distances;
#endif

void main() {
    ivec2 p = segmentPixel();
    Ray ray = kNoRay;
#if PATH_DIVISION == 1
    if (all(lessThan(p, sizeOf(seeds))))
        imageStore(distances, p, vec4(0.0));
#endif
    if (all(lessThan(p, sizeOf(seeds))) && isSurface(p)) {
        uint seed = fetch(seeds, p).x;
        VisiblePoint x1 = visiblePoint(p, eyeOf(seed));
        vec3 tangent = tangentOf(x1.bsdf.normal, x1.instance);
        vec2 u = vec2(randomNumber(seed, kDimensionBounceU), randomNumber(seed, kDimensionBounceV));
        float lobe = randomNumber(seed, kDimensionLobe);
        vec3 direction = sampleDirection(x1.bsdf, tangent, lobe, u);
        Scattering s = scatter(x1.bsdf, direction);
        if (s.pdf > 0.0) {
            float scale = dot(x1.bsdf.normal, direction) / s.pdf;
            vec3 first, second, signal0, signal1;
            divisorsOf(x1.bsdf, first, second);
            signalsOf(Lobes(s.diffuse * scale, s.specular * scale), first, second, signal0,
                      signal1);
            imageStore(weight0, p, vec4(signal0, s.pdf));
#if PATH_DIVISION == 1
            imageStore(weight1, p, vec4(signal1, lobe < x1.bsdf.pSpecular ? 1.0 : 0.0));
#endif
            ray = Ray(x1.origin, direction, kFar);
        }
    }
    listRay(ray, p);
}
