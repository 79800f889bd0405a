#version 450 core
// SPDX-License-Identifier: MIT

// One iteration of the reconstruction of the temporal gradient, on the grid of strata: delta and
// Delta are filtered alike, with the weights that filter the luminance of the strata. Schied et al.
// 2018, "Gradient Estimation for Real-Time Adaptive Temporal Filtering", section 4.3.
// With CHANNELS pairs of light are filtered so: "Change of light" in docs/pipeline.md.

#include "lib/edge_stopping.glsl"
#include "lib/fetch.glsl"
#include "lib/kernel.glsl"
#include "shared/bindings.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;
layout(std140, binding = kPassBlock) uniform Params {
    EdgeStopping params;
};

#ifdef CHANNELS
Float4Texture(before);   // rgb: light of the sample before; a: share of strata with a sample
Float4Texture(now);      // rgb: its light now; a: mean luminance
Float4Texture(products); // before . before, before . now, now . now, variance of luminance
writeonly uniform image2D filteredBefore, filteredNow, filteredProducts;
#else
Float4Texture(gradient); // delta, Delta, mean luminance, variance of luminance
writeonly uniform image2D filtered;
#endif
Float4Texture(strataGuides); // xyz: normal; w: depth, 0 marks background
Float2Texture(strataSlope);  // meters per pixel

// Contents of a stratum, which are averaged with the weights of the filter; the variance with their
// squares.
struct Content {
#ifdef CHANNELS
    vec4 before, now; // now.a: mean luminance
    vec3 products;
#else
    vec3 change; // z: mean luminance
#endif
    float variance;
};

#ifdef CHANNELS

Content contentOf(ivec2 s) {
    vec4 p = fetch(products, s);
    return Content(fetch(before, s), fetch(now, s), p.xyz, p.w);
}
float luminanceOf(Content c) {
    return c.now.a;
}
float varianceAt(ivec2 s) {
    return fetch(products, s).w;
}
void add(inout Content sum, float weight, Content c) {
    sum.before += weight * c.before;
    sum.now += weight * c.now;
    sum.products += weight * c.products;
    sum.variance += weight * weight * c.variance;
}
void store(ivec2 s, Content sum, float weight) {
    imageStore(filteredBefore, s, sum.before / weight);
    imageStore(filteredNow, s, sum.now / weight);
    imageStore(filteredProducts, s, vec4(sum.products / weight, sum.variance / (weight * weight)));
}
const Content kNothing = Content(vec4(0.0), vec4(0.0), vec3(0.0), 0.0);

#else

Content contentOf(ivec2 s) {
    vec4 g = fetch(gradient, s);
    return Content(g.xyz, g.w);
}
float luminanceOf(Content c) {
    return c.change.z;
}
float varianceAt(ivec2 s) {
    return fetch(gradient, s).w;
}
void add(inout Content sum, float weight, Content c) {
    sum.change += weight * c.change;
    sum.variance += weight * weight * c.variance;
}
void store(ivec2 s, Content sum, float weight) {
    imageStore(filtered, s, vec4(sum.change / weight, sum.variance / (weight * weight)));
}
const Content kNothing = Content(vec3(0.0), 0.0);

#endif

float smoothedVariance(ivec2 s, ivec2 last) {
    const float kBinomial[2] = float[](1.0 / 2.0, 1.0 / 4.0);
    float sum = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            sum += kBinomial[abs(x)] * kBinomial[abs(y)] *
                   varianceAt(clamp(s + ivec2(x, y), ivec2(0), last));
    return sum;
}

void main() {
    ivec2 s = ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = sizeOf(strataGuides) - 1;
    if (any(greaterThan(s, last)))
        return;

    Content center = contentOf(s);
    vec4 guide = fetch(strataGuides, s);
    if (guide.w == 0.0) {
        store(s, center, 1.0);
        return;
    }

    EdgeStops stops = edgeStops(guide, fetch(strataSlope, s).xy, params.sigmaDepth);
    addLuminanceStop(stops, luminanceOf(center), smoothedVariance(s, last), params.sigmaLuminance);
    if (params.sigmaLuminance == 0.0) // stands for no luminance stop
        stops.luminanceScale = 0.0;

    Content sum = kNothing;
    float weightSum = 0.0;
    for (int y = -KERNEL_RADIUS; y <= KERNEL_RADIUS; ++y) {
        for (int x = -KERNEL_RADIUS; x <= KERNEL_RADIUS; ++x) {
            ivec2 offset = ivec2(x, y) * params.step;
            ivec2 t = s + offset;
            if (any(lessThan(t, ivec2(0))) || any(greaterThan(t, last)))
                continue;
            Content other = contentOf(t);
            vec2 inPixels = vec2(offset) * float(kStratumSize);
            bool isCenter = x == 0 && y == 0;
            float stop = edgeWeight(stops, fetch(strataGuides, t), luminanceOf(other), inPixels,
                                    params.sigmaNormal);
            // `precise`: the same bits, whichever way textures are fetched.
            precise float w = kernelWeight(x, y) * (isCenter ? 1.0 : stop);
            add(sum, w, other);
            weightSum += w;
        }
    }
    store(s, sum, weightSum);
}
