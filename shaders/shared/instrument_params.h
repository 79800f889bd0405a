// SPDX-License-Identifier: MIT
#pragma once
#include "shared/interop.h"
SHARED_BEGIN

// Instruments that look at a frame's images and change nothing.

// Pixels along each edge of the block that one workgroup of an instrument walks over: 16 a thread.
const int kInstrumentBlock = 32;

// Texels that the probe writes for each block:
// 0: foreground pixels; sums of the filtered picture's luminance, of the variance, of lambda
// 1: sums of alpha and of the history length; squared deviations of raw's luminance and of the raw
//    picture's luminance from their means in the block
// 2: those two means: of each an anchor, which is the value of one pixel, and what to add to it
const int kProbeTexels = 3;

// The pixels first <= p < end, which are inside the picture.
struct ProbeParams {
    ivec2 first;
    ivec2 end;
};

// Texels of the image in which reasons are counted: one a history reason, then one a fate. The last
// of each kind also counts the codes above it.
const uint kHistoryBins = 8u;
const uint kFateBins = 16u;

// Findings of a pass at one texel, where it is compiled with INSPECT: see shaders/lib/inspect.glsl.
// Values that it does not compute there stay 0.

// One of the four pixels of the frame before that a history is interpolated between. The tests are
// in the order of the members, and none is made after one that failed.
struct HistoryTap {
    ivec2 pixel;
    float weight;  // bilinear; the four sum to 1
    int reason;    // kHistory...
    uint instance; // seen there
    float depth;   // seen there, meters
    float cosine;  // between the normal seen there and that of the surface
    float unused0;
};

const int kHistoryTaps = 4;

// Findings of denoise/temporal.comp at a pixel.
struct TemporalFindings {
    ivec2 texel;   // whose they are
    vec2 position; // of its surface in the frame before, pixels, their centers at integers
    HistoryTap taps[kHistoryTaps]; // in the order (0, 0), (1, 0), (0, 1), (1, 1)
    float depth;                   // of its surface in the frame before, meters
    float depthTolerance;          // meters
    float validWeight;             // B: of the taps that passed all tests
    float leastWeight;             // 1 / (N + 1), N as used
    vec3 fetchedColor;             // of the history, before it is clamped
    float fetchedSamples;          // N, before it is cut
    vec2 fetchedMoments;
    ivec2 lambdaStratum; // the own one, or where lambda is the largest
    vec2 range;          // low and high percentile of the raw luminance around
    float outside;       // how far the history is outside that range
    float newSamples;    // how much of a new sample the newest one is
    vec3 clampLow;       // bounds of the color
    float unused1;
    vec3 clampHigh;
    float unused2;
    vec3 usedColor;    // of the history, as it is blended
    float usedSamples; // N, as it is blended
    vec4 change;       // of a counted history: E, v, factor, strata that have changed
    vec4 accumulated;  // the results, as in the images of that name
    vec4 moments;
    vec4 control;
};

// Findings of denoise/gradient.comp at a stratum.
struct GradientFindings {
    ivec2 texel;   // the stratum
    float before;  // luminance of the stratum's sample in the frame before
    float now;     // and in this one
    vec4 gradient; // the result, as in the image of that name
};

struct DifferenceParams {
    int isAbsolute; // 1: |a - b|, 0: a - b
    int unused0, unused1, unused2;
};

SHARED_END
