// SPDX-License-Identifier: MIT
// Seeds and the numbers that follow from them: a Halton sequence over frames, shifted in each pixel
// by a blue-noise tile (Cranley and Patterson 1976; Georgiev and Fajardo 2016, "Blue-noise dithered
// sampling").

#include "lib/fetch.glsl"
#include "lib/frame.glsl"
#include "lib/hash.glsl"
#include "lib/seed.glsl"

FloatTexture(noiseTile); // 128 x 128, [0, 1)

// Dimensions of a pixel's random sequence.
const uint kDimensionLight = 0u; // picks the light
const uint kDimensionLightU = 1u;
const uint kDimensionLightV = 2u;
const uint kDimensionAoU = 3u;
const uint kDimensionAoV = 4u;
const uint kDimensionBounceU = 3u; // no path has an ambient occlusion ray
const uint kDimensionBounceV = 4u;
const uint kDimensionLobe = 5u;
const uint kDimensionBounceLight = 6u; // 6 to 8: as 0 to 2, seen from the second surface

// Digits of `index` in a prime base, mirrored at the point. The division is by multiplication:
// exact for index < 2^18, as (index + 1/2) / base is never nearer to an integer than 1 / (2 base).
float radicalInverse(uint index, float base, int digits) {
    float inverse = 1.0 / base;
    float n = float(index), scale = inverse, sum = 0.0;
    for (int i = 0; i < digits; ++i) {
        float quotient = floor((n + 0.5) * inverse);
        sum += (n - quotient * base) * scale;
        scale *= inverse;
        n = quotient;
    }
    return sum;
}

// Halton 1960: coordinate `dimension` of point `index`. The digits suffice for 18 bits. Dimensions
// 6 to 8 have the bases of 0 to 2 again: they form no integrand with those.
float halton(uint index, uint dimension) {
    if (dimension >= kDimensionBounceLight)
        dimension -= kDimensionBounceLight;
    if (dimension == 0u)
        return float(bitfieldReverse(index) >> 8) * (1.0 / 16777216.0);
    if (dimension == 1u)
        return radicalInverse(index, 3.0, 12);
    if (dimension == 2u)
        return radicalInverse(index, 5.0, 8);
    if (dimension == 3u)
        return radicalInverse(index, 7.0, 7);
    if (dimension == 4u)
        return radicalInverse(index, 11.0, 6);
    return radicalInverse(index, 13.0, 5);
}

// A number in [0, 1). The run's seed moves the tile and the sequence, in each dimension on its own.
float randomNumber(uint seed, uint dimension) {
    uint shift = hash2(frame.seed, dimension);
    uvec2 place = uvec2(seed, seed >> kTileBits) + uvec2(shift, shift >> kTileBits);
    float u = fetch(noiseTile, ivec2(place & kTileMask)).x + halton(seedFrame(seed), dimension) +
              float(mixBits(shift) >> 8) * (1.0 / 16777216.0);
    return min(fract(u), 0.99999994);
}
