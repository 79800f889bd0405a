#version 450 core
// SPDX-License-Identifier: MIT

// The logarithms of luminance of a picture, second half: their mean, the exposure that takes it to
// middle gray, and this frame's step towards that. One workgroup; each thread adds up every 64th
// tile, and the first one their sums: always in the same order.

#include "lib/fetch.glsl"
#include "lib/frame.glsl"
#include "shared/post_params.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;
layout(std140, binding = kPassBlock) uniform Params {
    ExposureParams params;
};

Float4Texture(sums); // a texel a tile: sum of log2 of luminance, foreground pixels
Float4Texture(previousExposure);

// One texel: stops, mean of log2 of luminance, foreground pixels, 1.
writeonly uniform image2D exposure;

const float kMiddleGray = 0.18;
const uint kThreads = kTileSize * kTileSize;

shared vec2 parts[kThreads];

void main() {
    uint own = gl_LocalInvocationIndex;
    ivec2 tiles = sizeOf(sums);
    vec2 part = vec2(0.0);
    for (int tile = int(own); tile < tiles.x * tiles.y; tile += int(kThreads))
        part += fetch(sums, ivec2(tile % tiles.x, tile / tiles.x)).xy;
    parts[own] = part;
    memoryBarrierShared();
    barrier();
    if (own != 0u)
        return;

    vec2 total = vec2(0.0);
    for (uint i = 0u; i < kThreads; ++i)
        total += parts[i];
    vec4 previous = fetch(previousExposure, ivec2(0));
    bool hasPrevious = frame.historyValid != 0u && previous.w != 0.0;
    float start = hasPrevious ? previous.x : 0.0;
    float mean = total.y > 0.0 ? total.x / total.y : 0.0;
    float target = clamp(log2(kMiddleGray) - mean, -params.limit, params.limit);
    float share = hasPrevious ? params.adaptation : 1.0;
    float stops = total.y > 0.0 ? start + share * (target - start) : start;
    imageStore(exposure, ivec2(0), vec4(stops, mean, total.y, 1.0));
}
