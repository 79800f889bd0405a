#version 450 core

// Forward projection, second half: the winner of each stratum replaces the visibility sample and
// the seed of the pixel it landed on. Every later pass treats that pixel like any other. Schied et
// al. 2018, section 4.1.
//
// With EXTRA_SAMPLES no pixel is replaced: visibility and seeds have one texel a stratum, and what
// is there is shaded beside the picture. Departs from the paper: one ray in nine more, and a
// picture whose noise does not know of the gradient.

#include "lib/counters.glsl"
#include "lib/forward.glsl"
#include "lib/frame.glsl"
#include "lib/geometry.glsl"
#include "lib/seed.glsl"
#include "lib/strata.glsl"
#include "lib/view.glsl"
#include "shared/denoise_params.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;

UintTexture(owners);
Uint2Texture(claims);
Uint4Texture(previousVisibility);
UintTexture(previousSeeds);
Float4Texture(previousRaw);

writeonly uniform uimage2D visibility;
writeonly uniform uimage2D seeds;
writeonly uniform uimage2D samples; // previous luminance, place in the stratum + 1, source, fate

// Of the sample that this stratum offered, now that all have claimed.
uint fateOf(ivec2 s) {
    uvec4 claim = fetch(claims, s);
    ivec2 landed = ivec2(claim.y & 0xffffu, claim.y >> 16);
    bool lost = claim.x == kFateCarried && fetch(owners, landed).x != claimKey(s);
    return lost ? kFateLostRace : claim.x;
}

void main() {
    ivec2 s = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(s, frame.strata)))
        return;
    uint fate = fateOf(s);
    uint key = fetch(owners, s).x;
    if (key == 0u) {
        imageStore(samples, s, uvec4(0u, 0u, 0u, fate));
#ifdef EXTRA_SAMPLES
        imageStore(visibility, s, uvec4(0u));
        imageStore(seeds, s, uvec4(0u));
#endif
        return;
    }

    ivec2 source = candidatePixel(claimedStratum(key), frame.frame - 1u);
    uvec4 sampled = fetch(previousVisibility, source);
    ivec2 q = clamp(ivec2(pixelOf(clipNow(sampled))), ivec2(0), frame.size - 1);
#ifdef EXTRA_SAMPLES
    ivec2 target = s;
#else
    ivec2 target = q;
#endif
    imageStore(visibility, target, sampled);
    imageStore(seeds, target, uvec4(fetch(previousSeeds, source).x));

    ivec2 inStratum = q - s * int(kStratumSize);
    uint place = 1u + uint(inStratum.x) + kStratumSize * uint(inStratum.y);
    imageStore(samples, s,
               uvec4(floatBitsToUint(fetch(previousRaw, source).a), place,
                     uint(source.x) | (uint(source.y) << 16), fate));
    count(kCounterGradientSamples, 1u);
}
