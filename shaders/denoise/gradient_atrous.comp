#version 450 core
// SPDX-License-Identifier: MIT

// One iteration of the reconstruction of the temporal gradient, on the grid of strata: delta and
// Delta are filtered alike, with the weights that filter the luminance of the strata. Schied et al.
// 2018, "Gradient Estimation for Real-Time Adaptive Temporal Filtering", section 4.3.

#include "lib/edge_stopping.glsl"
#include "lib/fetch.glsl"
#include "lib/kernel.glsl"
#include "shared/bindings.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;
layout(std140, binding = kPassBlock) uniform Params {
    EdgeStopping params;
};

Float4Texture(gradient);     // delta, Delta, mean luminance, variance of luminance
Float4Texture(strataGuides); // xyz: normal; w: depth, 0 marks background
Float2Texture(strataSlope);  // meters per pixel

writeonly uniform image2D filtered;

float smoothedVariance(ivec2 s, ivec2 last) {
    const float kBinomial[2] = float[](1.0 / 2.0, 1.0 / 4.0);
    float sum = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            sum += kBinomial[abs(x)] * kBinomial[abs(y)] *
                   fetch(gradient, clamp(s + ivec2(x, y), ivec2(0), last)).w;
    return sum;
}

void main() {
    ivec2 s = ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = sizeOf(gradient) - 1;
    if (any(greaterThan(s, last)))
        return;

    vec4 center = fetch(gradient, s);
    vec4 guide = fetch(strataGuides, s);
    if (guide.w == 0.0) {
        imageStore(filtered, s, center);
        return;
    }

    EdgeStops stops = edgeStops(guide, fetch(strataSlope, s).xy, params.sigmaDepth);
    addLuminanceStop(stops, center.z, smoothedVariance(s, last), params.sigmaLuminance);
    if (params.sigmaLuminance == 0.0) // stands for no luminance stop
        stops.luminanceScale = 0.0;

    vec3 sum = vec3(0.0);
    float varianceSum = 0.0, weightSum = 0.0;
    for (int y = -KERNEL_RADIUS; y <= KERNEL_RADIUS; ++y) {
        for (int x = -KERNEL_RADIUS; x <= KERNEL_RADIUS; ++x) {
            ivec2 offset = ivec2(x, y) * params.step;
            ivec2 t = s + offset;
            if (any(lessThan(t, ivec2(0))) || any(greaterThan(t, last)))
                continue;
            vec4 other = fetch(gradient, t);
            vec2 inPixels = vec2(offset) * float(kStratumSize);
            bool isCenter = x == 0 && y == 0;
            float stop =
                edgeWeight(stops, fetch(strataGuides, t), other.z, inPixels, params.sigmaNormal);
            // `precise`: the same bits, whichever way textures are fetched.
            precise float w = kernelWeight(x, y) * (isCenter ? 1.0 : stop);
            sum += w * other.xyz;
            varianceSum += w * w * other.w;
            weightSum += w;
        }
    }
    imageStore(filtered, s, vec4(sum / weightSum, varianceSum / (weightSum * weightSum)));
}
