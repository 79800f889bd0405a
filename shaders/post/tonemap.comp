#version 450 core
// SPDX-License-Identifier: MIT

// Linear radiance to the display: exposure, a tone mapper (TONE_MAPPER), sRGB encoding.

#include "lib/color.glsl"
#include "lib/exposure.glsl"
#include "lib/fetch.glsl"
#include "lib/frame.glsl"
#include "lib/tone_map.glsl"
#include "shared/post_params.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;
layout(std140, binding = kPassBlock) uniform Params {
    TonemapParams params;
};

Float4Texture(composed);
writeonly uniform image2D display;

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, frame.size)))
        return;
    vec3 mapped = toneMap(exposureOf(params.exposure) * fetch(composed, p).rgb);
    imageStore(display, p, vec4(params.encodes != 0 ? encodeSrgb(mapped) : mapped, 1.0));
}
