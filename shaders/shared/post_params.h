// SPDX-License-Identifier: MIT
#pragma once
#include "shared/interop.h"
SHARED_BEGIN

struct MeanParams {
    float scale; // 1 / number of samples
    float unused0, unused1, unused2;
};

// Tone mappers, lib/tone_map.glsl.
const int kToneAces = 0;
const int kToneAgx = 1;
const int kToneNeutral = 2;
const int kToneNone = 3;

struct TonemapParams {
    float exposure; // factor, by hand
    int encodes;    // 0: linear light of the display; 1: sRGB
    float unused0, unused1;
};

struct ExposureParams {
    float adaptation; // share of the way to its target that the exposure goes in a frame
    float limit;      // stops, of both signs
    float unused0, unused1;
};

struct TaaParams {
    float blend;    // least weight of the newest frame
    float clip;     // standard deviations
    float exposure; // factor, by hand
    int weighted;   // 1: colors count by 1 / (1 + exposed luminance)
};

SHARED_END
