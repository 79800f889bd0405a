#version 450 core
// SPDX-License-Identifier: MIT

// How many pixels have each reason for their history; with FATES how many strata have each fate of
// their gradient sample. Counted in the workgroup first, since all pixels share few bins.

#include "lib/fetch.glsl"
#include "shared/bindings.h"
#include "shared/instrument_params.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;

#ifdef FATES
Uint4Texture(samples); // w: fate
#else
Float4Texture(control); // w: reason
Float4Texture(guides);  // w: depth; 0: background, which does not count
#endif

layout(r32ui) uniform uimage2D counts; // kHistoryBins, then kFateBins

#ifdef FATES
const uint kFirstBin = kHistoryBins;
const uint kBins = kFateBins;
ivec2 extent() {
    return sizeOf(samples);
}
bool isCounted(ivec2 p) {
    return true;
}
uint codeAt(ivec2 p) {
    return fetch(samples, p).w;
}
#else
const uint kFirstBin = 0u;
const uint kBins = kHistoryBins;
ivec2 extent() {
    return sizeOf(control);
}
bool isCounted(ivec2 p) {
    return fetch(guides, p).w != 0.0;
}
uint codeAt(ivec2 p) {
    return uint(clamp(fetch(control, p).w, 0.0, float(kBins)) + 0.5);
}
#endif

shared uint bins[kBins];

void main() {
    uint own = gl_LocalInvocationIndex;
    if (own < kBins)
        bins[own] = 0u;
    memoryBarrierShared();
    barrier();

    const int kStride = int(kTileSize);
    const int kSteps = kInstrumentBlock / kStride;
    ivec2 end = extent();
    ivec2 begin = ivec2(gl_WorkGroupID.xy) * kInstrumentBlock + ivec2(gl_LocalInvocationID.xy);
    for (int i = 0; i < kSteps * kSteps; ++i) {
        ivec2 p = begin + kStride * ivec2(i % kSteps, i / kSteps);
        if (all(lessThan(p, end)) && isCounted(p))
            atomicAdd(bins[min(codeAt(p), kBins - 1u)], 1u);
    }
    memoryBarrierShared();
    barrier();

    if (own < kBins && bins[own] != 0u)
        imageAtomicAdd(counts, ivec2(kFirstBin + own, 0), bins[own]);
}
