#version 450 core
// SPDX-License-Identifier: MIT

// Computes the factors of path signals after the filter: the albedos that they were divided by.

#include "lib/visible_point.glsl"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;

writeonly uniform image2D divisor0;
#if PATH_DIVISION != 0
writeonly uniform image2D divisor1;
#endif

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, sizeOf(guides))))
        return;
    vec3 first = vec3(0.0), second = vec3(0.0);
    if (isSurface(p))
        divisorsOf(visiblePoint(p, frame.cameraPosition).bsdf, first, second);
    imageStore(divisor0, p, vec4(first, 1.0));
#if PATH_DIVISION != 0
    imageStore(divisor1, p, vec4(second, 1.0));
#endif
}
