#version 450 core

// Adds one sample per pixel to a running sum: the converged reference.

#include "lib/fetch.glsl"
#include "lib/frame.glsl"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;

Float4Texture(raw);
layout(rgba32f) uniform image2D sum;

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, frame.size)))
        return;
    imageStore(sum, p, imageLoad(sum, p) + fetch(raw, p));
}
