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
    float exposure; // factor
    float unused0, unused1, unused2;
};

SHARED_END
