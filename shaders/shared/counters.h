// SPDX-License-Identifier: MIT
#pragma once
#include "shared/interop.h"
SHARED_BEGIN

// Texels of the counters image.
const uint kCounterRays = 0u;            // traced
const uint kCounterGradientSamples = 1u; // strata that hold one
const uint kCounterInvalid = 2u;         // NaN or infinite values replaced
const uint kCounterCount = 3u;

SHARED_END
