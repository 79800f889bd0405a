#version 450 core
// SPDX-License-Identifier: MIT

// One iteration of the edge-avoiding a-trous wavelet filter, guided by variance.
// Schied et al. 2017, "Spatiotemporal Variance-Guided Filtering", section 4.4, equations 3 to 5.

#include "lib/color.glsl"
#include "lib/edge_stopping.glsl"
#include "lib/fetch.glsl"
#include "lib/kernel.glsl"
#include "shared/bindings.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;
layout(std140, binding = kPassBlock) uniform Params {
    EdgeStopping params;
};

Float4Texture(signal); // rgb: demodulated signal; a: variance of its luminance
Float4Texture(guides); // xyz: normal; w: depth, 0 marks background
Float2Texture(slope);  // meters per pixel

writeonly uniform image2D filtered;

// The variance estimate is itself noisy; a 3x3 binomial kernel steadies the range it sets.
float smoothedVariance(ivec2 p, ivec2 last) {
    const float kBinomial[2] = float[](1.0 / 2.0, 1.0 / 4.0);
    float sum = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            sum += kBinomial[abs(x)] * kBinomial[abs(y)] *
                   fetch(signal, clamp(p + ivec2(x, y), ivec2(0), last)).a;
    return sum;
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = sizeOf(signal) - 1;
    if (any(greaterThan(p, last)))
        return;

    vec4 center = fetch(signal, p);
    vec4 guide = fetch(guides, p);
    if (guide.w == 0.0) {
        imageStore(filtered, p, center);
        return;
    }

    vec2 centerSlope = fetch(slope, p).xy;
    float centerLuminance = luminance(center.rgb);
    float luminanceScale =
        1.0 / (params.sigmaLuminance * sqrt(max(smoothedVariance(p, last), 0.0)) + 1e-6);

    vec3 signalSum = vec3(0.0);
    float varianceSum = 0.0, weightSum = 0.0;
    for (int y = -KERNEL_RADIUS; y <= KERNEL_RADIUS; ++y) {
        for (int x = -KERNEL_RADIUS; x <= KERNEL_RADIUS; ++x) {
            ivec2 offset = ivec2(x, y) * params.step;
            ivec2 q = p + offset;
            if (any(lessThan(q, ivec2(0))) || any(greaterThan(q, last)))
                continue;
            vec4 otherGuide = fetch(guides, q);
            if (otherGuide.w == 0.0)
                continue;
            vec4 other = fetch(signal, q);

            float exponent =
                depthExponent(guide.w, otherGuide.w, centerSlope, vec2(offset), params.sigmaDepth) +
                abs(centerLuminance - luminance(other.rgb)) * luminanceScale;
            float w = kernelWeight(x, y) *
                      normalWeight(guide.xyz, otherGuide.xyz, params.sigmaNormal) * exp(-exponent);
            signalSum += w * other.rgb;
            varianceSum += w * w * other.a; // the variance of a weighted sum: weights squared
            weightSum += w;
        }
    }
    imageStore(filtered, p, vec4(signalSum / weightSum, varianceSum / (weightSum * weightSum)));
}
