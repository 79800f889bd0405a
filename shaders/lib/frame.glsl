// SPDX-License-Identifier: MIT
// The frame block.

#include "shared/bindings.h"
#include "shared/frame.h"

layout(std140, binding = kFrameBlock) uniform Frame {
    FrameUniforms frame;
};
