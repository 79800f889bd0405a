#version 450 core
// SPDX-License-Identifier: MIT

// Linear radiance to the display: exposure, a curve with a shoulder, sRGB encoding.
// The curve is the rational fit of Narkowicz 2015, "ACES Filmic Tone Mapping Curve", per channel.

#include "lib/color.glsl"
#include "lib/fetch.glsl"
#include "lib/frame.glsl"
#include "shared/post_params.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;
layout(std140, binding = kPassBlock) uniform Params {
    TonemapParams params;
};

Float4Texture(composed);
writeonly uniform image2D display;

vec3 filmic(vec3 x) {
    return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, frame.size)))
        return;
    imageStore(display, p, vec4(encodeSrgb(filmic(params.exposure * fetch(composed, p).rgb)), 1.0));
}
