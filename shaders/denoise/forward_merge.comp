#version 450 core

// Forward projection, second half: the winner of each stratum replaces the visibility sample and
// the seed of the pixel it landed on. Every later pass treats that pixel like any other. Schied et
// al. 2018, section 4.1.

#include "lib/counters.glsl"
#include "lib/forward.glsl"
#include "lib/frame.glsl"
#include "lib/geometry.glsl"
#include "lib/seed.glsl"
#include "lib/strata.glsl"
#include "lib/view.glsl"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;

UintTexture(owners);
Uint4Texture(previousVisibility);
UintTexture(previousSeeds);
Float4Texture(previousRaw);

writeonly uniform uimage2D visibility;
writeonly uniform uimage2D seeds;
writeonly uniform uimage2D samples;

void main() {
    ivec2 s = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(s, frame.strata)))
        return;
    uint key = fetch(owners, s).x;
    if (key == 0u) {
        imageStore(samples, s, uvec4(0u));
        return;
    }

    ivec2 source = candidatePixel(claimedStratum(key), frame.frame - 1u);
    uvec4 sampled = fetch(previousVisibility, source);
    ivec2 q = clamp(ivec2(pixelOf(clipNow(sampled))), ivec2(0), frame.size - 1);
    imageStore(visibility, q, sampled);
    imageStore(seeds, q, uvec4(fetch(previousSeeds, source).x));

    ivec2 inStratum = q - s * int(kStratumSize);
    uint place = 1u + uint(inStratum.x) + kStratumSize * uint(inStratum.y);
    imageStore(samples, s,
               uvec4(floatBitsToUint(fetch(previousRaw, source).a), place,
                     uint(source.x) | (uint(source.y) << 16), 0u));
    count(kCounterGradientSamples, 1u);
}
