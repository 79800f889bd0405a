#version 450 core
// SPDX-License-Identifier: MIT

// Variance of the luminance from its moments: over time, or over 7x7 pixels where the history is
// too short to tell. Schied et al. 2017, section 4.2. That of one sample, as published, or of the
// mean of the history's samples.

#include "lib/edge_stopping.glsl"
#include "lib/fetch.glsl"
#include "shared/bindings.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;
layout(std140, binding = kPassBlock) uniform Params {
    VarianceParams params;
};

Float4Texture(accumulated);
Float4Texture(moments); // mean, mean square, history length
Float4Texture(guides);
Float2Texture(slope);

writeonly uniform image2D filtered; // rgb: the signal; a: variance

const int kRadius = 3;

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = sizeOf(moments) - 1;
    if (any(greaterThan(p, last)))
        return;
    vec4 guide = fetch(guides, p);
    if (guide.w == 0.0) {
        imageStore(filtered, p, vec4(0.0));
        return;
    }

    vec3 own = fetch(moments, p).xyz;
    float history = own.z;
    // Both branches of an `if` are run by llvmpipe; a loop that does not begin costs nothing.
    int radius = history < params.minHistory ? kRadius : -1;
    vec2 sum = vec2(0.0);
    float weightSum = 0.0;
    vec2 centerSlope = radius < 0 ? vec2(0.0) : fetch(slope, p).xy;
    EdgeStops stops = edgeStops(guide, centerSlope, params.sigmaDepth);
    for (int y = -radius; y <= radius; ++y) {
        for (int x = -radius; x <= radius; ++x) {
            ivec2 q = p + ivec2(x, y);
            if (any(lessThan(q, ivec2(0))) || any(greaterThan(q, last)))
                continue;
            float w = edgeWeight(stops, fetch(guides, q), 0.0, vec2(x, y), params.sigmaNormal);
            sum += w * fetch(moments, q).xy;
            weightSum += w;
        }
    }
    vec2 mean = radius < 0 ? own.xy : sum / weightSum;
    float variance = max(0.0, mean.y - mean.x * mean.x);
    float samples = max(history, 1.0);
    if (params.varianceExponent != 0.0)
        variance *= pow(samples, -params.varianceExponent);
    else if (radius >= 0)
        variance *= params.minHistory / samples;
    variance *= 1.0 + params.shortHistoryBoost / (samples * samples);
    imageStore(filtered, p, vec4(fetch(accumulated, p).rgb, variance));
}
