#version 450 core
// SPDX-License-Identifier: MIT

// Forward projection, second half: the winner of each stratum replaces the visibility sample and
// the seed of the pixel it landed on. Every later pass treats that pixel like any other. Schied et
// al. 2018, section 4.1. The landing pixel is read and not computed again: two programs may round
// differently.
//
// With EXTRA_SAMPLES no pixel is replaced: visibility and seeds have one texel a stratum, and what
// is there is shaded beside the picture. Departs from the paper: one ray in nine more, and a
// picture whose noise does not know of the gradient.

#include "lib/counters.glsl"
#include "lib/fetch.glsl"
#include "lib/frame.glsl"
#include "lib/strata.glsl"
#include "shared/denoise_params.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;

UintTexture(owners);
Uint2Texture(claims); // fate so far, pixel where it landed
Uint4Texture(previousVisibility);
UintTexture(previousSeeds);

writeonly uniform uimage2D visibility;
writeonly uniform uimage2D seeds;
writeonly uniform uimage2D samples; // landing of the offer, place in the stratum + 1, source, fate

// Of the sample that this stratum offered, now that all have claimed.
uint fateOf(ivec2 s, uvec2 claim) {
    bool lost =
        claim.x == kFateCarried && fetch(owners, stratumOf(unpackPixel(claim.y))).x != claimKey(s);
    return lost ? kFateLostRace : claim.x;
}

void main() {
    ivec2 s = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(s, frame.strata)))
        return;
    uvec2 offered = fetch(claims, s).xy;
    uint fate = fateOf(s, offered);
    uint key = fetch(owners, s).x;
    if (key == 0u) {
        imageStore(samples, s, uvec4(offered.y, 0u, 0u, fate));
#ifdef EXTRA_SAMPLES
        imageStore(visibility, s, uvec4(0u));
        imageStore(seeds, s, uvec4(0u));
#endif
        return;
    }

    ivec2 winner = claimedStratum(key);
    ivec2 source = candidatePixel(winner, frame.frame - 1u);
    ivec2 q = unpackPixel(fetch(claims, winner).y);
#ifdef EXTRA_SAMPLES
    ivec2 target = s;
#else
    ivec2 target = q;
#endif
    imageStore(visibility, target, fetch(previousVisibility, source));
    imageStore(seeds, target, uvec4(fetch(previousSeeds, source).x));

    ivec2 inStratum = q - s * int(kStratumSize);
    uint place = 1u + uint(inStratum.x) + kStratumSize * uint(inStratum.y);
    imageStore(samples, s, uvec4(offered.y, place, packPixel(source), fate));
    count(kCounterGradientSamples, 1u);
}
