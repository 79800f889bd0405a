#version 450 core
// SPDX-License-Identifier: MIT

// Two percentiles of the raw luminance of each tile of 8x8 pixels, and its mean between them: what
// one frame alone says about how dark and how bright it is there. The idea is that of the SVGF in
// the renderer merian. The values are sorted by counting, so the result does not depend on the
// order of the threads.

#include "lib/fetch.glsl"
#include "shared/bindings.h"
#include "shared/denoise_params.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in; // one workgroup is one tile
layout(std140, binding = kPassBlock) uniform Params {
    PercentileParams params;
};

Float4Texture(raw); // a: luminance
Float4Texture(guides);

writeonly uniform image2D luminanceRange; // low, high, foreground pixels, 0; a texel a tile

const int kPixels = int(kTileSize * kTileSize);

shared float values[kPixels]; // negative: not in the picture, or background
shared float sorted[kPixels];

float percentile(float q, int count) {
    float place = clamp(q, 0.0, 1.0) * float(count - 1);
    int below = int(place);
    return mix(sorted[below], sorted[min(below + 1, count - 1)], place - float(below));
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    int own = int(gl_LocalInvocationIndex);
    ivec2 last = sizeOf(raw) - 1;
    ivec2 inside = min(p, last);
    bool counts = p == inside && fetch(guides, inside).w != 0.0;
    float value = counts ? fetch(raw, inside).a : -1.0;
    values[own] = value;
    memoryBarrierShared();
    barrier();

    int count = 0, rank = 0;
    float sum = 0.0;
    for (int i = 0; i < kPixels; ++i) {
        float other = values[i];
        count += other >= 0.0 ? 1 : 0;
        sum += max(other, 0.0);
        // Among equals the first one comes first, so that each place is taken once.
        rank += other >= 0.0 && (other < value || (other == value && i < own)) ? 1 : 0;
    }
    if (counts)
        sorted[rank] = value;
    memoryBarrierShared();
    barrier();

    if (own == 0) {
        vec2 range = vec2(0.0);
        if (count > 0) {
            // A history is a mean, and the mean of rare bright samples is above most of them.
            float mean = sum / float(count);
            range.x = min(mean, percentile(params.lowPercentile, count));
            range.y = max(mean, percentile(params.highPercentile, count));
        }
        imageStore(luminanceRange, ivec2(gl_WorkGroupID.xy), vec4(range, float(count), 0.0));
    }
}
