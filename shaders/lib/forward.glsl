// SPDX-License-Identifier: MIT
// Where a surface sample of the previous frame stands now. Schied et al. 2018, section 4.1.

#include "lib/frame.glsl"
#include "lib/geometry.glsl"
#include "lib/view.glsl"

// The world point of a visibility sample with the transforms of this frame.
vec3 positionNow(uvec4 sampled) {
    uint instance = sampled.x - 1u;
    Triangle t =
        worldTriangle(triangleVertices(instance, sampled.y), instanceTransform(instance, false));
    return pointOn(t, uintBitsToFloat(sampled.zw));
}

vec4 clipNow(uvec4 sampled) {
    return frame.clipFromWorld * vec4(positionNow(sampled), 1.0);
}
