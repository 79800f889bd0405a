// SPDX-License-Identifier: MIT
// The 3x3 strata of gradient samples.

#include "lib/encoding.glsl"
#include "lib/frame.glsl"
#include "lib/hash.glsl"

ivec2 stratumOf(ivec2 p) {
    return p / int(kStratumSize);
}

ivec2 stratumSize(ivec2 s) {
    return min(ivec2(kStratumSize), frame.size - s * int(kStratumSize));
}

// The pixel that a stratum offers as a gradient sample, a pure function of stratum, frame and run.
ivec2 candidatePixel(ivec2 s, uint inFrame) {
    ivec2 size = stratumSize(s);
    uint number = hash3(packPixel(s), inFrame, frame.seed) % uint(size.x * size.y);
    return s * int(kStratumSize) + ivec2(number % uint(size.x), number / uint(size.x));
}

// Keys of the claim: a permutation of the strata that is another one in every frame. 0 means no
// claim, so the one stratum whose key is 0 never wins.
uint claimKey(ivec2 s) {
    return mixBits(uint(s.y * frame.strata.x + s.x) ^ mixBits(frame.frame));
}

ivec2 claimedStratum(uint key) {
    uint index = unmixBits(key) ^ mixBits(frame.frame);
    return ivec2(index % uint(frame.strata.x), index / uint(frame.strata.x));
}
