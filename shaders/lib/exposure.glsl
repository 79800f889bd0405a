// SPDX-License-Identifier: MIT
// The factor of linear radiance: what is set by hand, and with AUTO_EXPOSURE what the picture asks
// for.

#include "lib/fetch.glsl"

#ifdef AUTO_EXPOSURE
Float4Texture(exposure); // one texel; x: stops

float exposureOf(float byHand) {
    return byHand * exp2(fetch(exposure, ivec2(0)).x);
}
#else
float exposureOf(float byHand) {
    return byHand;
}
#endif
