#version 450 core
// SPDX-License-Identifier: MIT

// The mean of the samples of a reference, and how much one sample's luminance varies around it.

#include "lib/color.glsl"
#include "lib/fetch.glsl"
#include "lib/frame.glsl"
#include "shared/post_params.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;
layout(std140, binding = kPassBlock) uniform Params {
    MeanParams params;
};

Float4Texture(sum); // rgb: of the signal; a: of the square of its luminance
writeonly uniform image2D mean;

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, frame.size)))
        return;
    vec4 moments = fetch(sum, p) * params.scale;
    float l = luminance(moments.rgb);
    imageStore(mean, p, vec4(moments.rgb, max(0.0, moments.a - l * l)));
}
