#version 450 core
// SPDX-License-Identifier: MIT

// Tells of each stratum by how much its light has changed, and whether by one factor. "Change of
// light" in docs/pipeline.md. Our own; the samples are those of Schied et al. 2018,
// section 4.2, whose lambda is that of luminance alone.

#include "lib/color.glsl"
#include "lib/fetch.glsl"
#include "shared/bindings.h"
#include "shared/denoise_params.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;
layout(std140, binding = kPassBlock) uniform Params {
    ChangeParams params;
};

Float4Texture(before);   // rgb: mean light before; a: share of strata with a sample
Float4Texture(now);      // rgb: mean light now
Float4Texture(products); // means of before . before, before . now, now . now
writeonly uniform image2D lambda;
writeonly uniform image2D change; // what is left of lambda^2, variance of a sample, factor, weight

const float kTiny = 1e-12;
const float kSameSum = 4e-6; // relative: sums that differ by rounding alone
const float kLargestScale = 8.0;

float sumOf(vec3 v) {
    return v.r + v.g + v.b;
}

float largestOf(vec3 v) {
    return max(v.r, max(v.g, v.b));
}

// `light` is the larger luminance of the two frames.
float lambdaOf(vec3 a, vec3 b, float light) {
    if (light <= params.deltaFloor)
        return 0.0;
    if (params.over == kChangeOfLuminance)
        return min(1.0, abs(luminance(b) - luminance(a)) / light);
    return min(1.0, largestOf(abs(b - a) / (max(a, b) + 0.02 * light)));
}

void main() {
    ivec2 s = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(s, sizeOf(before))))
        return;
    vec4 first = fetch(before, s);
    vec3 a = first.rgb, b = fetch(now, s).rgb, p = fetch(products, s).xyz;
    float n = max(first.a, 1e-6); // sums over samples are n times their means
    float light = max(luminance(a), luminance(b));
    float sumA = sumOf(a), sumB = sumOf(b);

    vec3 larger = max(a, b);
    float squares = max(dot(a, a), dot(b, b)) + kTiny;
    float variance = max(0.0, max(p.x * n - dot(a, a), p.z * n - dot(b, b))) / squares;

    float factor = sumA > params.deltaFloor ? sumB / sumA : 1.0;
    float unexplained = max(0.0, p.z - 2.0 * factor * p.y + factor * factor * p.x);
    float rho = unexplained / (n * (dot(larger, larger) / (n * n) + kTiny));
    bool isForced = params.forceLambda >= 0.0;
    float l = isForced ? params.forceLambda : lambdaOf(a, b, light);
    float belief = l * l / (l * l + params.scaleDoubt * rho + kTiny);
    if (params.scaleHistory == 0 || isForced)
        belief = 0.0;

    float ratio = (sumB + 1e-3 * light + 1e-6) / (sumA + 1e-3 * light + 1e-6);
    float scale = 1.0 + belief * (clamp(ratio, 0.0, kLargestScale) - 1.0);
    if (abs(sumB - sumA) <= kSameSum * max(sumA, sumB))
        scale = 1.0;
    float weight = first.a > 0.0 ? light : 0.0;
    imageStore(lambda, s, vec4(l));
    imageStore(change, s, vec4(l * l * (1.0 - belief), variance, scale, isForced ? 1.0 : weight));
}
