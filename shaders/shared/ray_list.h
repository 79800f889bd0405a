// SPDX-License-Identifier: MIT
#pragma once
#include "shared/interop.h"
SHARED_BEGIN

// Rays that are to be traced, without gaps: each square of pixels has a segment of the list, of
// which the first so many rays are there. Which pixel's ray stands where follows from the picture
// alone.
const uint kSegmentSize = 16u;  // pixels along each edge of a segment's square
const uint kSegmentRays = 256u; // places in a segment: a ray a pixel
const uint kSegmentWords = 8u;  // of 32 bits, one for each place
const uint kTexelsPerRay = 2u;  // origin, tMax; direction, pixel as x | y << 16

SHARED_END
