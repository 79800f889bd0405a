// SPDX-License-Identifier: MIT
#pragma once
#include "shared/interop.h"
SHARED_BEGIN

// What every pass of a frame may read: block kFrameBlock, std140.
// Pixel p covers [p, p + 1); row 0 is the top of the picture; clip y points up.
struct FrameUniforms {
    mat4 clipFromWorld;         // this frame
    mat4 previousClipFromWorld; // the frame before
    mat4 viewFromWorld;         // the camera looks along -Z
    mat4 previousViewFromWorld;
    vec3 cameraPosition; // meters, world
    float tanHalfFov;    // of the vertical field of view
    vec3 ambient;        // radiance of the uniform surroundings
    float extent;        // diagonal of the scene's box, meters: the unit of all distances
    ivec2 size;          // pixels
    ivec2 strata;        // ceil(size / kStratumSize)
    uint frame;          // frame number of this frame
    uint seed;           // of the whole run
    uint historyValid;   // 0 on the first frame, after a resize, a reset or a scene change
    uint lightTriangleCount;
    float aoRadius;              // meters
    float signalClamp;           // upper bound of each channel of the raw signal, radiance
    uint sampleIndex;            // replaces the frame number in new seeds
    float regularization;        // least alpha of the second surface of a path
    vec3 previousCameraPosition; // that of this frame if there is no frame before
    float unused0;
    vec2 jitter; // pixels from their centers: where in each of them the picture is seen
    float unused1, unused2;
};

SHARED_END
