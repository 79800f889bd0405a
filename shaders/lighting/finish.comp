#version 450 core
// SPDX-License-Identifier: MIT

// Makes the traced light the signal: finite, bounded, and with its luminance beside it.

#include "lib/color.glsl"
#include "lib/counters.glsl"
#include "lib/frame.glsl"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;

layout(rgba32f) uniform image2D raw; // rgb: radiance; a, afterwards: its luminance

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, imageSize(raw))))
        return;
    vec3 signal = imageLoad(raw, p).rgb;
    if (any(isnan(signal)) || any(isinf(signal))) {
        count(kCounterInvalid, 1u);
        signal = vec3(0.0);
    }
    // Bounded once, here, before the gradient and the filter alike.
    signal = clamp(signal, vec3(0.0), vec3(frame.signalClamp));
    imageStore(raw, p, vec4(signal, luminance(signal)));
}
