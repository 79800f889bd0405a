// SPDX-License-Identifier: MIT
// Between pixels, view space and clip space.

#include "lib/frame.glsl"

// The point at view depth 1 behind a position in pixels.
vec3 viewRay(vec2 pixel) {
    vec2 size = vec2(frame.size);
    vec2 ndc = vec2(2.0 * pixel.x / size.x - 1.0, 1.0 - 2.0 * pixel.y / size.y);
    return vec3(ndc.x * frame.tanHalfFov * size.x / size.y, ndc.y * frame.tanHalfFov, -1.0);
}

// Returns the ray in world space; its length is one meter of depth.
vec3 worldRay(vec2 pixel) {
    return transpose(mat3(frame.viewFromWorld)) * viewRay(pixel);
}

// A point of world space in clip space; the same bits wherever it is asked for.
vec4 clipOf(mat4 clipFromWorld, vec3 position) {
    precise vec4 clip = clipFromWorld[0] * position.x + clipFromWorld[1] * position.y +
                        clipFromWorld[2] * position.z + clipFromWorld[3];
    return clip;
}

// The position in pixels of a point in clip space, w > 0; the same bits wherever it is asked for.
vec2 pixelOf(vec4 clip) {
    precise vec2 ndc = clip.xy / clip.w;
    precise vec2 pixel = vec2(0.5 + 0.5 * ndc.x, 0.5 - 0.5 * ndc.y) * vec2(frame.size);
    return pixel;
}

bool isInsideFrustum(vec4 clip) {
    return clip.w > 0.0 && abs(clip.x) < clip.w && abs(clip.y) < clip.w && clip.z >= 0.0 &&
           clip.z <= clip.w;
}
