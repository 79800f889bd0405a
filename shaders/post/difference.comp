#version 450 core
// SPDX-License-Identifier: MIT

// What one image has more than another, channel by channel. SOURCE says how both are declared:
// Float4Texture, Float2Texture or FloatTexture; channels that they do not have become 0.

#include "lib/fetch.glsl"
#include "shared/bindings.h"
#include "shared/instrument_params.h"

#ifndef SOURCE
#define SOURCE Float4Texture
#endif

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;
layout(std140, binding = kPassBlock) uniform Params {
    DifferenceParams params;
};

SOURCE(minuend);
SOURCE(subtrahend);
writeonly uniform image2D difference;

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, imageSize(difference))))
        return;
    vec4 more = fetch(minuend, p) - fetch(subtrahend, p);
    imageStore(difference, p, params.isAbsolute != 0 ? abs(more) : more);
}
