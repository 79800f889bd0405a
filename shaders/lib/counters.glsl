// SPDX-License-Identifier: MIT
// Sums over the frame that are read back on demand.

#include "shared/counters.h"

layout(r32ui) uniform uimage2D counters;

void count(uint counter, uint amount) {
    imageAtomicAdd(counters, ivec2(counter, 0), amount);
}
