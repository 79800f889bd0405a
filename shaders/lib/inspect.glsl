// SPDX-License-Identifier: MIT
// A pass that can be compiled to inspect one texel of its outputs. With INSPECT it runs one thread,
// for the texel that `findings` names, and writes there what it computes on its way:
//
//     Inspectable(TemporalFindings);    // at file scope
//     ivec2 p = texelToCompute();
//     NOTE(taps[i].weight, weight);     // findings.taps[i].weight = weight
//
// Without INSPECT the pass is the one of the frame: NOTE() is nothing, and its arguments are not
// evaluated.

#pragma once

#include "shared/bindings.h"

#ifdef INSPECT

#define Inspectable(Findings)                                                                      \
    layout(local_size_x = 1) in;                                                                   \
    layout(std430) restrict buffer Inspected {                                                     \
        Findings findings;                                                                         \
    }
#define NOTE(member, value) findings.member = value
#define texelToCompute() findings.texel

#else

#define Inspectable(Findings) layout(local_size_x = kTileSize, local_size_y = kTileSize) in
#define NOTE(member, value)
#define texelToCompute() ivec2(gl_GlobalInvocationID.xy)

#endif
