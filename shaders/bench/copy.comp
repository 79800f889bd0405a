#version 450 core
// SPDX-License-Identifier: MIT

// Copies an image: what the device moves where nothing is computed.

#include "lib/fetch.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

Float4Texture(source);
writeonly uniform image2D target;

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, sizeOf(source))))
        return;
    imageStore(target, p, fetch(source, p));
}
