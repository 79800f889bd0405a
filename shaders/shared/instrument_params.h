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

// Pixels that a history is interpolated between, and texels written for each: its visibility, its
// guides and its moments, the latter two as bits. The column after them begins with the raw signal
// that the gradient sample had in the frame before, as bits.
const int kHistoryTaps = 4;
const int kHistoryTapTexels = 3;

struct HistoryTapsParams {
    ivec2 pixel; // whose surface it is
    ivec2 unused0;
};

struct DifferenceParams {
    int isAbsolute; // 1: |a - b|, 0: a - b
    int unused0, unused1, unused2;
};

SHARED_END
