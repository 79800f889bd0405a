// SPDX-License-Identifier: MIT
#pragma once
#include "shared/interop.h"
SHARED_BEGIN

// How numbers become colors.
const int kMapRadiance = 0;  // rgb; `high` is white
const int kMapScalar = 1;    // one channel from `low` to `high`: violet, teal, yellow
const int kMapLogarithm = 2; // the same, equal steps for equal factors; low > 0
const int kMapSigned = 3;    // one channel: blue at -high, dark at 0, orange at high
const int kMapVector = 4;    // three channels from `low` to `high` as red, green, blue
const int kMapRepeat = 5;    // three channels, each starting anew after `high`: a grid in space
const int kMapDirection =
    6;                    // two channels: hue is the direction, brightness the length up to `high`
const int kMapNumber = 7; // one channel holds a whole number: a color each, 0 is dark

struct DebugViewParams {
    int map;
    int channel;        // of the scalar maps; the others begin with channel 0
    int pixelsPerTexel; // 1, or kStratumSize for images of strata
    int isFloatBits;    // integer images: 1: the bits of floats, 0: whole numbers
    float low;
    float high;
    float unused0;
    float unused1;
};

SHARED_END
