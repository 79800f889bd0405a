#version 450 core
// SPDX-License-Identifier: MIT

// Adds one sample per pixel to the sums of a reference. With NEXT_SEEDS it also makes the seeds of
// the next sample: the same pixels with the next number of the sequence.
//
// Kahan 1965, "Further remarks on reducing truncation errors": it keeps the mean within 6e-8 for
// any number of samples; a plain sum of 65,536 is off by 1e-5.

#include "lib/fetch.glsl"
#include "lib/frame.glsl"
#include "lib/seed.glsl"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;

Float4Texture(raw);
#ifdef NEXT_SEEDS
layout(r32ui) uniform uimage2D seeds;
#endif
layout(rgba32f) uniform image2D sum;  // rgb: of the signal; a: of the square of its luminance
layout(rgba32f) uniform image2D lost; // what has been added to the sum too much, by rounding

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, frame.size)))
        return;
    vec4 sampled = fetch(raw, p);
    vec4 before = imageLoad(sum, p);
    // A compiler that takes these for numbers without rounding finds that nothing is ever lost.
    precise vec4 value = vec4(sampled.rgb, sampled.a * sampled.a) - imageLoad(lost, p);
    precise vec4 after = before + value;
    precise vec4 added = after - before;
    precise vec4 tooMuch = added - value;
    imageStore(sum, p, after);
    imageStore(lost, p, tooMuch);
#ifdef NEXT_SEEDS
    imageStore(seeds, p, imageLoad(seeds, p) + uvec4(1u << (2 * kTileBits), 0u, 0u, 0u));
#endif
}
