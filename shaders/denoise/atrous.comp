#version 450 core
// SPDX-License-Identifier: MIT

// One iteration of the edge-avoiding a-trous wavelet filter, guided by variance.
// Schied et al. 2017, "Spatiotemporal Variance-Guided Filtering", section 4.4, equations 3 to 5.
// There are two forms of the loop over the taps, with the same sums but for their rounding.

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

// A pixel that is filtered.
struct Pixel {
    vec4 center; // the signal there
    EdgeStops stops;
    vec3 signalSum;
    float varianceSum, weightSum;
};

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

Pixel pixelAt(ivec2 p, ivec2 last, vec4 guide) {
    vec4 center = fetch(signal, p);
    EdgeStops stops = edgeStops(guide, fetch(slope, p).xy, params.sigmaDepth);
    addLuminanceStop(stops, luminance(center.rgb), smoothedVariance(p, last),
                     params.sigmaLuminance);
    return Pixel(center, stops, vec3(0.0), 0.0, 0.0);
}

// The tap at p + step k. That at p itself has no stop.
void addTap(inout Pixel pixel, ivec2 k, vec4 otherGuide, vec4 other) {
    ivec2 towards = k.y < 0 || (k.y == 0 && k.x < 0) ? -k : k; // one of two opposite taps
    float w = kernelWeight(k.x, k.y);
    if (k != ivec2(0))
        w *= edgeWeight(pixel.stops, otherGuide, luminance(other.rgb),
                        float(params.step) * vec2(towards), params.sigmaNormal);
    pixel.signalSum += w * other.rgb;
    pixel.varianceSum += w * w * other.a; // the variance of a weighted sum: weights squared
    pixel.weightSum += w;
}

vec4 meanOf(Pixel pixel) {
    return vec4(pixel.signalSum / pixel.weightSum,
                pixel.varianceSum / (pixel.weightSum * pixel.weightSum));
}

#ifdef FETCH_BY_IMAGE

// A thread filters p and p + (0, step), whose kernels share all rows but two: 30 fetches in place
// of 50 for 5x5. Taps outside are not tested for: a load there gives zeros, which are background.
// The taps are written out: llvmpipe's compiler would leave such a large loop as it is, and look up
// the kernel for each tap.

void addToBoth(inout Pixel first, inout Pixel second, ivec2 p, ivec2 k) {
    ivec2 q = p + params.step * k;
    vec4 otherGuide = fetch(guides, q);
    vec4 other = fetch(signal, q);
    if (k.y <= KERNEL_RADIUS)
        addTap(first, k, otherGuide, other);
    if (k.y > -KERNEL_RADIUS)
        addTap(second, k - ivec2(0, 1), otherGuide, other);
}

void storeFiltered(ivec2 p, Pixel pixel) {
    imageStore(filtered, p, pixel.stops.depth == 0.0 ? pixel.center : meanOf(pixel));
}

#define TAP(x, y) addToBoth(first, second, p, ivec2(x, y));
#if KERNEL_RADIUS == 2
#define ROW(y) TAP(-2, y) TAP(-1, y) TAP(0, y) TAP(1, y) TAP(2, y)
#define ROWS ROW(-2) ROW(-1) ROW(0) ROW(1) ROW(2) ROW(3)
#else
#define ROW(y) TAP(-1, y) TAP(0, y) TAP(1, y)
#define ROWS ROW(-1) ROW(0) ROW(1) ROW(2)
#endif

void main() {
    // Of each 2 step rows, threads have the first half; step is a power of two.
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    ivec2 p = cell + ivec2(0, cell.y & -params.step);
    ivec2 below = p + ivec2(0, params.step);
    ivec2 last = sizeOf(signal) - 1;
    if (any(greaterThan(p, last)))
        return;

    Pixel first = pixelAt(p, last, fetch(guides, p));
    Pixel second = pixelAt(below, last, fetch(guides, below));
    ROWS;
    storeFiltered(p, first);
    if (below.y <= last.y)
        storeFiltered(below, second);
}

#else

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = sizeOf(signal) - 1;
    if (any(greaterThan(p, last)))
        return;

    vec4 guide = fetch(guides, p);
    if (guide.w == 0.0) {
        imageStore(filtered, p, fetch(signal, p));
        return;
    }

    Pixel pixel = pixelAt(p, last, guide);
    for (int y = -KERNEL_RADIUS; y <= KERNEL_RADIUS; ++y) {
        for (int x = -KERNEL_RADIUS; x <= KERNEL_RADIUS; ++x) {
            ivec2 q = p + params.step * ivec2(x, y);
            if (any(lessThan(q, ivec2(0))) || any(greaterThan(q, last)))
                continue;
            addTap(pixel, ivec2(x, y), fetch(guides, q), fetch(signal, q));
        }
    }
    imageStore(filtered, p, meanOf(pixel));
}

#endif
