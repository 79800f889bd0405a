#version 450 core
// SPDX-License-Identifier: MIT

// The logarithms of luminance of a picture, first half: the sum over each tile. One thread adds up
// the pixels of one tile in their order, so that the sum has the same bits in every run.

#include "lib/color.glsl"
#include "lib/fetch.glsl"
#include "shared/bindings.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;

Float4Texture(composed);
Float4Texture(guides);

writeonly uniform image2D sums; // a texel a tile: sum of log2 of luminance, foreground pixels

const float kDarkest = -10.0; // log2 of luminance; what is darker counts as this

void main() {
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(tile, imageSize(sums))))
        return;
    ivec2 size = sizeOf(composed);
    ivec2 first = tile * int(kTileSize);
    ivec2 end = min(first + int(kTileSize), size);
    float sum = 0.0, count = 0.0;
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) {
            bool counts = fetch(guides, ivec2(x, y)).w != 0.0;
            float l = luminance(fetch(composed, ivec2(x, y)).rgb);
            sum += counts ? log2(max(l, exp2(kDarkest))) : 0.0;
            count += counts ? 1.0 : 0.0;
        }
    imageStore(sums, tile, vec4(sum, count, 0.0, 0.0));
}
