#version 450 core

// The mean of a sum of samples.

#include "lib/fetch.glsl"
#include "lib/frame.glsl"
#include "shared/post_params.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;
layout(std140, binding = kPassBlock) uniform Params {
    MeanParams params;
};

Float4Texture(sum);
writeonly uniform image2D mean;

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, frame.size)))
        return;
    imageStore(mean, p, vec4(fetch(sum, p).rgb * params.scale, 0.0));
}
