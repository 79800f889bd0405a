// SPDX-License-Identifier: MIT
// The walk of a compute shader over pixels.

#include "shared/bindings.h"

// The pixel of this invocation. Eight consecutive lanes cover 4x2 pixels, which keeps rays
// together, and rows of workgroups alternate between the halves of the picture, since llvmpipe
// gives the first half of the list of workgroups to one thread and the second half to the other.
ivec2 tilePixel() {
    uint lane = gl_LocalInvocationIndex;
    uint block = lane >> 3;
    uvec2 inTile =
        uvec2((lane & 3u) | ((block & 1u) << 2), ((lane >> 2) & 1u) | ((block >> 1) << 1));
    uint rows = gl_NumWorkGroups.y;
    uint upper = (rows + 1u) / 2u;
    uint y = gl_WorkGroupID.y;
    uint row = y < upper ? 2u * y : 2u * (y - upper) + 1u;
    return ivec2(uvec2(gl_WorkGroupID.x, row) * kTileSize + inTile);
}
