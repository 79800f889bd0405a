// SPDX-License-Identifier: MIT
// A pixel's seed: its place in the blue-noise tile and the frame number. All random numbers of the
// pixel follow from it (lib/random.glsl), so storing it is storing the whole random sequence.

const int kTileBits = 7;
const uint kTileMask = (1u << kTileBits) - 1u;

uint newSeed(ivec2 p, uint index) {
    return (uint(p.x) & kTileMask) | ((uint(p.y) & kTileMask) << kTileBits) |
           (index << (2 * kTileBits));
}

// The frame number (modulo 2^18) that a seed was made in.
uint seedFrame(uint seed) {
    return seed >> (2 * kTileBits);
}
