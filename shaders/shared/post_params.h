// SPDX-License-Identifier: MIT
#pragma once
#include "shared/interop.h"
SHARED_BEGIN

struct MeanParams {
    float scale; // 1 / number of samples
    float unused0, unused1, unused2;
};

struct TonemapParams {
    float exposure; // factor
    float unused0, unused1, unused2;
};

SHARED_END
