#version 450 core
// SPDX-License-Identifier: MIT

// What a rectangle of the picture holds, as sums and squared deviations over blocks of it. Each
// thread takes the same pixels of its block and threads are combined in a fixed order: the same
// picture gives the same bits. Deviations are kept about the mean (Welford 1962; combined as in
// Chan, Golub and LeVeque 1979), and the mean is kept as the value of one pixel and a distance from
// it, so that nothing large is ever subtracted from something as large.

#include "lib/color.glsl"
#include "lib/fetch.glsl"
#include "shared/bindings.h"
#include "shared/instrument_params.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;
layout(std140, binding = kPassBlock) uniform Params {
    ProbeParams params;
};

Float4Texture(filtered); // rgb: signal; a: its variance
Float4Texture(raw);      // rgb: signal of one sample; a: luminance
Float4Texture(albedo);
Float4Texture(guides);  // w: depth; 0: background, which does not count
Float4Texture(control); // lambda, alpha, history length, reason
#ifdef OTHER_SIGNAL     // the picture is lit by two
Float4Texture(otherFiltered);
Float4Texture(otherRaw);
Float4Texture(otherDemodulation);
#endif

writeonly uniform image2D sums; // kProbeTexels texels a block: see shared/instrument_params.h

const uint kThreads = kTileSize * kTileSize;
const int kStride = int(kTileSize);
const int kSteps = kInstrumentBlock / kStride; // of a thread, along each edge

// Of pixels: how many, and of the luminance of raw (x) and of the raw picture (y) the mean, which
// is anchor + offset, and the sum of squared deviations from it.
struct Moments {
    float count;
    vec2 anchor;
    vec2 offset;
    vec2 squares;
};

shared vec4 counted[kThreads];    // count; sums of luminance, variance, lambda
shared vec4 controlled[kThreads]; // sums of alpha and history length; squares
shared vec4 means[kThreads];      // anchor, offset

// With one pixel more.
Moments with(Moments m, vec2 x) {
    m.count += 1.0;
    m.anchor = m.count == 1.0 ? x : m.anchor;
    precise vec2 y = x - m.anchor;
    precise vec2 before = y - m.offset;
    m.offset += before / m.count;
    m.squares += before * (y - m.offset);
    return m;
}

// Of the pixels of both.
Moments together(Moments a, Moments b) {
    if (a.count == 0.0)
        return b;
    float count = a.count + b.count;
    precise vec2 apart = (b.anchor - a.anchor) + (b.offset - a.offset);
    vec2 offset = a.offset + apart * (b.count / count);
    vec2 squares = a.squares + b.squares + apart * apart * (a.count * b.count / count);
    return b.count == 0.0 ? a : Moments(count, a.anchor, offset, squares);
}

Moments momentsOf(uint thread) {
    return Moments(counted[thread].x, means[thread].xy, means[thread].zw, controlled[thread].zw);
}

void takeIn(uint own, uint other) {
    Moments both = together(momentsOf(own), momentsOf(other));
    counted[own] += counted[other];
    controlled[own] = vec4(controlled[own].xy + controlled[other].xy, both.squares);
    means[own] = vec4(both.anchor, both.offset);
}

void main() {
    ivec2 block = ivec2(gl_WorkGroupID.xy);
    uint own = gl_LocalInvocationIndex;
    ivec2 begin = params.first + block * kInstrumentBlock + ivec2(gl_LocalInvocationID.xy);

    Moments moments = Moments(0.0, vec2(0.0), vec2(0.0), vec2(0.0));
    vec3 lit = vec3(0.0);   // luminance, variance, lambda
    vec2 state = vec2(0.0); // alpha, history length
    for (int i = 0; i < kSteps * kSteps; ++i) {
        ivec2 p = begin + kStride * ivec2(i % kSteps, i / kSteps);
        ivec2 inside = min(p, params.end - 1);
        if (p != inside || fetch(guides, inside).w == 0.0)
            continue;
        vec4 signal = fetch(filtered, p);
        vec4 noisy = fetch(raw, p);
        vec4 driven = fetch(control, p);
        vec3 surface = fetch(albedo, p).rgb;
        vec3 otherLit = vec3(0.0), otherNoise = vec3(0.0);
#ifdef OTHER_SIGNAL
        vec3 factor = fetch(otherDemodulation, p).rgb;
        otherLit = fetch(otherFiltered, p).rgb * factor;
        otherNoise = fetch(otherRaw, p).rgb * factor;
#endif
        moments = with(moments, vec2(noisy.a, luminance(noisy.rgb * surface + otherNoise)));
        lit += vec3(luminance(signal.rgb * surface + otherLit), signal.a, driven.x);
        state += driven.yz;
    }
    counted[own] = vec4(moments.count, lit);
    controlled[own] = vec4(state, moments.squares);
    means[own] = vec4(moments.anchor, moments.offset);
    memoryBarrierShared();
    barrier();

    // Of 64 threads 8 take in 7 others each, and one of those takes in the rest: two barriers,
    // where halving needs six, and for the other threads the loops do not begin.
    for (uint left = kThreads; left > 1u; left /= kTileSize) {
        uint kept = left / kTileSize;
        for (uint other = own + kept; own < kept && other < left; other += kept)
            takeIn(own, other);
        memoryBarrierShared();
        barrier();
    }

    if (own == 0u) {
        ivec2 texel = block * ivec2(kProbeTexels, 1);
        imageStore(sums, texel, counted[0]);
        imageStore(sums, texel + ivec2(1, 0), controlled[0]);
        imageStore(sums, texel + ivec2(2, 0), means[0]);
    }
}
