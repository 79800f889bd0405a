// SPDX-License-Identifier: MIT
// The walk of compute shaders over pixels, and over lists of rays.
//
// Eight consecutive lanes cover 4x2 pixels, which keeps rays together, and rows of workgroups
// alternate between the halves of the picture, since llvmpipe gives the first half of the list of
// workgroups to one thread and the second half to the other.

#include "shared/bindings.h"
#include "shared/ray_list.h"

uint alternatingRow() {
    uint upper = (gl_NumWorkGroups.y + 1u) / 2u;
    uint y = gl_WorkGroupID.y;
    return y < upper ? 2u * y : 2u * (y - upper) + 1u;
}

// The square of pixels, and the segment of a list, of this workgroup of kSegmentRays invocations.
uvec2 segmentSquare() {
    return uvec2(gl_WorkGroupID.x, alternatingRow());
}
uint segmentIndex() {
    uvec2 square = segmentSquare();
    return square.y * gl_NumWorkGroups.x + square.x;
}

// The pixel of this invocation: tiles of 8x8 pixels in blocks of 4x2.
ivec2 segmentPixel() {
    uint lane = gl_LocalInvocationIndex & 63u, tile = gl_LocalInvocationIndex >> 6u;
    uint block = lane >> 3u;
    uvec2 inTile =
        uvec2((lane & 3u) | ((block & 1u) << 2u), ((lane >> 2u) & 1u) | ((block >> 1u) << 1u));
    return ivec2(segmentSquare() * kSegmentSize + 8u * uvec2(tile & 1u, tile >> 1u) + inTile);
}

// The segment of this invocation of a walk over a list, with 64 invocations a workgroup, and its
// place in it.
void placeInList(out uint segment, out uint place) {
    const uint kGroups = kSegmentRays / 64u;
    segment = alternatingRow() * (gl_NumWorkGroups.x / kGroups) + gl_WorkGroupID.x / kGroups;
    place = (gl_WorkGroupID.x % kGroups) * 64u + gl_LocalInvocationIndex;
}
