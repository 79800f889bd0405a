#version 450 core

// Copies the history around the position that one pixel's surface had in the frame before, as
// denoise/temporal.comp is given it, and around the place that its stratum's gradient sample comes
// from. Only the device knows these places before the frame is finished.

#include "lib/fetch.glsl"
#include "shared/bindings.h"
#include "shared/instrument_params.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;
layout(std140, binding = kPassBlock) uniform Params {
    HistoryTapsParams params;
};

Float4Texture(motion);    // xy: to the position in the frame before, pixels
Uint4Texture(samples);    // strata; z: pixel that the gradient sample comes from
Uint4Texture(visibility); // of the frame before, as all below
Float4Texture(guides);
Float4Texture(moments);
Float4Texture(raw);

writeonly uniform uimage2D taps; // a column for each tap: see shared/instrument_params.h

uvec4 tapAt(ivec2 p) {
    // As app/workbench/pixel_facts.cpp finds it.
    ivec2 size = sizeOf(guides);
    vec2 position =
        clamp(vec2(params.pixel) + fetch(motion, params.pixel).xy, vec2(-4.0), vec2(size) + 4.0);
    ivec2 tap = ivec2(floor(position)) + ivec2(p.x & 1, p.x >> 1);
    ivec2 q = clamp(tap, ivec2(0), size - 1);
    if (p.y == 1)
        return floatBitsToUint(fetch(guides, q));
    if (p.y == 2)
        return floatBitsToUint(fetch(moments, q));
    return fetch(visibility, q);
}

uvec4 sampleRaw() {
    uint place = fetch(samples, params.pixel / int(kStratumSize)).z;
    ivec2 source = ivec2(place & 0xffffu, place >> 16u);
    return floatBitsToUint(fetch(raw, min(source, sizeOf(raw) - 1)));
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, ivec2(kHistoryTaps + 1, kHistoryTapTexels))))
        return;
    imageStore(taps, p, p.x < kHistoryTaps ? tapAt(p) : sampleRaw());
}
