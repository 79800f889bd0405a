// SPDX-License-Identifier: MIT
// Edge-stopping functions of both a-trous filters. Schied et al. 2017, section 4.4, equations 3
// to 5. Departure: the epsilon of the depth weight is relative to the depth, so no unit of length
// is fixed.

#include "shared/denoise_params.h"

// The exponents of the weights of depth and luminance are summed, since exp(a) exp(b) = exp(a + b).
float depthExponent(float depth, float otherDepth, vec2 slope, vec2 offset, float sigma) {
    return abs(depth - otherDepth) / (sigma * abs(dot(slope, offset)) + 1e-3 * depth);
}

float normalWeight(vec3 n, vec3 other, float sigma) {
    float cosine = max(dot(n, other), 0.0);
    return cosine > 0.0 ? pow(cosine, sigma) : 0.0;
}
