// SPDX-License-Identifier: MIT
// Edge-stopping functions of both a-trous filters and of the variance in space. Schied et al. 2017,
// section 4.4, equations 3 to 5. Departure: the epsilon of the depth weight is relative to the
// depth, so no unit of length is fixed.
// With NORMAL_SQUARINGS n the exponent of the normals is 2^n, and `sigma` is not read.

#include "shared/denoise_params.h"

const float kLn2 = 0.69314718056;

// The side of the filtered pixel in the weights of its taps. Weights are powers of 2 and not of e:
// the factor between the two is in these members.
struct EdgeStops {
    vec3 normal;
    float depth;
    vec2 depthReach;      // of the depth weight, per pixel of distance; meters
    float depthEpsilon;   // added to that; meters
    float luminance;      // of the filtered pixel; both are 0 where there is no luminance stop
    float luminanceScale; // over the reach of the luminance weight
};

// Stops of depth and normal alone. `guide` is that of the filtered pixel, `slope` in meters per
// pixel.
EdgeStops edgeStops(vec4 guide, vec2 slope, float sigmaDepth) {
    return EdgeStops(guide.xyz, guide.w, kLn2 * sigmaDepth * slope, kLn2 * (1e-3 * guide.w), 0.0,
                     0.0);
}

// `variance` is that of the luminance around the filtered pixel.
void addLuminanceStop(inout EdgeStops stops, float luminance, float variance, float sigma) {
    stops.luminance = luminance;
    stops.luminanceScale = 1.0 / (kLn2 * (sigma * sqrt(max(variance, 0.0)) + 1e-6));
}

float normalWeight(vec3 n, vec3 other, float sigma) {
    float cosine = max(dot(n, other), 0.0);
#ifdef NORMAL_SQUARINGS
    for (int i = 0; i < NORMAL_SQUARINGS; ++i)
        cosine *= cosine;
    return cosine;
#else
    return cosine > 0.0 ? pow(cosine, sigma) : 0.0;
#endif
}

// The weight of a tap: 0 on background. The sign of `offset`, in pixels, does not matter: a
// compiler that is given the same one for opposite taps divides once for both. The exponents of
// depth and luminance are summed, since exp(a) exp(b) = exp(a + b).
float edgeWeight(EdgeStops stops, vec4 otherGuide, float otherLuminance, vec2 offset,
                 float sigmaNormal) {
    float depthScale = 1.0 / (abs(dot(stops.depthReach, offset)) + stops.depthEpsilon);
    float exponent = abs(stops.depth - otherGuide.w) * depthScale +
                     abs(stops.luminance - otherLuminance) * stops.luminanceScale;
    float weight = normalWeight(stops.normal, otherGuide.xyz, sigmaNormal) * exp2(-exponent);
    return otherGuide.w == 0.0 ? 0.0 : weight;
}
