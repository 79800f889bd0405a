#version 450 core
// SPDX-License-Identifier: MIT

// Back-projects the history and blends the new sample into it, with an alpha for each pixel.
// Schied et al. 2017, section 4.1; Schied et al. 2018, section 4.4.
// Departure: the history length is the effective number of samples, which falls with alpha; the
// papers leave it as it is, and alpha then returns to its least value with a history of one sample.
// With the history law power the history is cut before alpha is taken from it, as in Q2RTX.
// Three competitors share this pass: a history clamped to its neighborhood (Karis 2014, Salvi
// 2016), lambda from percentiles of one frame (merian), and lambda that cuts the history length
// (NRD). So does the counted history, our own: lib/counted_history.glsl.
// With INSPECT the outputs are one pixel's TemporalFindings; see lib/inspect.glsl.
// With FOR_PLAN the choices of a plan are constants, and what it does not use is compiled away;
// without it they are those of the parameters. The results are the same bits.

#include "lib/color.glsl"
#include "lib/fetch.glsl"
#include "lib/frame.glsl"
#include "lib/inspect.glsl"
#include "shared/denoise_params.h"
#include "shared/instrument_params.h"

Inspectable(TemporalFindings);
layout(std140, binding = kPassBlock) uniform Params {
    TemporalParams params;
};

#ifndef FOR_PLAN
#define LAMBDA_SOURCE params.lambdaSource
#define LAMBDA_FETCH params.lambdaFetch
#define LAMBDA_USE params.lambdaUse
#define HISTORY_LAW params.historyLaw
#define CLAMP_RADIUS params.clampRadius
#define READS_CHANGE
#define COUNTS
#endif

Float4Texture(raw); // a: luminance
Uint4Texture(visibility);
Uint4Texture(previousVisibility);
Float4Texture(guides);
Float4Texture(previousGuides);
Float2Texture(slope);
Float4Texture(motion);
Float4Texture(previousColor);
Float4Texture(previousMoments);
FloatTexture(lambda);          // per stratum
Float4Texture(luminanceRange); // per tile: low, high, foreground pixels
#ifdef READS_CHANGE
Float4Texture(change); // per stratum: what is left of lambda^2, variance, factor, weight
#endif
#ifdef COUNTS
UintTexture(changed);  // one texel: strata whose light has changed
Uint4Texture(samples); // per stratum; y: place in it + 1 of the gradient sample
#endif

#ifndef INSPECT
writeonly uniform image2D accumulated; // a: luminance of the history before any clamp
writeonly uniform image2D moments;
writeonly uniform image2D control; // lambda, alpha, history length, reason
#endif

struct History {
    vec3 color;
    vec2 moments;
    float samples; // effective number; 0: none
    int reason;
    bool isBetween; // interpolated between pixels
};

void store(ivec2 p, vec4 newAccumulated, vec4 newMoments, vec4 newControl) {
#ifdef INSPECT
    findings.accumulated = newAccumulated;
    findings.moments = newMoments;
    findings.control = newControl;
#else
    imageStore(accumulated, p, newAccumulated);
    imageStore(moments, p, newMoments);
    imageStore(control, p, newControl);
#endif
}

// `tap` is its number, for who inspects it.
int tapReason(int tap, ivec2 q, uint instance, float depth, float tolerance, vec3 normal) {
    if (any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, frame.size)))
        return kHistoryOffScreen;
    NOTE(taps[tap].instance, fetch(previousVisibility, q).x);
    if (fetch(previousVisibility, q).x != instance)
        return kHistoryInstance;
    vec4 guide = fetch(previousGuides, q);
    NOTE(taps[tap].depth, guide.w);
    if (abs(guide.w - depth) > tolerance)
        return kHistoryDepth;
    float cosine = dot(guide.xyz, normal);
    NOTE(taps[tap].cosine, cosine);
    return cosine >= params.normalTolerance ? kHistoryKept : kHistoryNormal;
}

History fetchHistory(ivec2 p, vec3 normal) {
    History none = History(vec3(0.0), vec2(0.0), 0.0, kHistoryNone, false);
    vec4 moved = fetch(motion, p);
    if (frame.historyValid == 0u)
        return none;
    none.reason = kHistoryOffScreen;
    if (moved.w == 0.0)
        return none;

    // A surface that was far outside stays far outside: the clamp keeps the integers in range.
    vec2 position = clamp(vec2(p) + moved.xy, vec2(-4.0), vec2(frame.size) + 4.0);
    ivec2 corner = ivec2(floor(position));
    vec2 f = position - vec2(corner);
    vec2 surfaceSlope = fetch(slope, p).xy;
    float tolerance = params.depthTolerance * (abs(surfaceSlope.x) + abs(surfaceSlope.y)) +
                      kDepthEpsilon * moved.z;
    uint instance = fetch(visibility, p).x;
    NOTE(position, position);
    NOTE(depth, moved.z);
    NOTE(depthTolerance, tolerance);

    History history = none;
    float weightSum = 0.0, largest = -1.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 place = ivec2(i & 1, i >> 1);
        ivec2 q = corner + place;
        float weight = (place.x == 1 ? f.x : 1.0 - f.x) * (place.y == 1 ? f.y : 1.0 - f.y);
        int reason = tapReason(i, q, instance, moved.z, tolerance, normal);
        NOTE(taps[i].pixel, q);
        NOTE(taps[i].weight, weight);
        NOTE(taps[i].reason, reason);
        if (weight > largest) {
            largest = weight;
            history.reason = reason;
        }
        if (reason != kHistoryKept || weight == 0.0)
            continue;
        vec4 m = fetch(previousMoments, q);
        history.color += weight * fetch(previousColor, q).rgb;
        history.moments += weight * m.xy;
        history.samples += weight * m.z;
        weightSum += weight;
    }
    NOTE(validWeight, weightSum);
    if (weightSum < kLeastWeight)
        return History(vec3(0.0), vec2(0.0), 0.0, history.reason, false);
    history.color /= weightSum;
    history.moments /= weightSum;
    history.samples /= weightSum;
    history.reason = kHistoryKept;
    history.isBetween = any(lessThan(abs(f - 0.5), vec2(0.5 - kBetweenPixels)));
    return history;
}

// The history held to what the raw signal around makes plausible.
vec3 clampToNeighborhood(vec3 color, ivec2 p) {
    vec3 mean = vec3(0.0), squares = vec3(0.0); // Welford 1962: no difference of large sums
    float count = 0.0;
    // A loop that does not begin costs nothing; see variance.comp.
    for (int y = -CLAMP_RADIUS; y <= CLAMP_RADIUS; ++y) {
        for (int x = -CLAMP_RADIUS; x <= CLAMP_RADIUS; ++x) {
            ivec2 q = p + ivec2(x, y);
            if (any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, frame.size)))
                continue;
            if (fetch(guides, q).w == 0.0)
                continue;
            vec3 value = fetch(raw, q).rgb;
            vec3 off = value - mean;
            count += 1.0;
            mean += off / count;
            squares += off * (value - mean);
        }
    }
    vec3 reach = params.clampSigmas * sqrt(squares / max(count, 1.0));
    NOTE(clampLow, mean - reach);
    NOTE(clampHigh, mean + reach);
    return count == 0.0 ? color : clamp(color, mean - reach, mean + reach);
}

// Returns by how much a luminance is outside the percentiles of the raw signal around, in widths of
// their range.
float lambdaOfRange(ivec2 p, float historyLuminance) {
    // Centers of tiles lie at 8 t + 4 in pixel coordinates. A tile counts by its foreground.
    vec2 position = (vec2(p) + 0.5) / float(kTileSize) - 0.5;
    ivec2 corner = ivec2(floor(position));
    vec2 f = position - vec2(corner);
    vec2 range = vec2(0.0);
    float weightSum = 0.0;
    int tiles = LAMBDA_SOURCE == kLambdaFromRange ? 4 : 0;
    for (int i = 0; i < tiles; ++i) {
        ivec2 place = ivec2(i & 1, i >> 1);
        vec4 tile =
            fetch(luminanceRange, clamp(corner + place, ivec2(0), sizeOf(luminanceRange) - 1));
        float weight = (place.x == 1 ? f.x : 1.0 - f.x) * (place.y == 1 ? f.y : 1.0 - f.y) * tile.z;
        range += weight * tile.xy;
        weightSum += weight;
    }
    range /= max(weightSum, 1e-6);
    NOTE(range, range);
    float outside = max(0.0, max(range.x - historyLuminance, historyLuminance - range.y));
    NOTE(outside, outside);
    return min(1.0, params.percentileSlope * outside / (range.y - range.x + 1e-4));
}

float lambdaOf(ivec2 s) {
    return fetch(lambda, clamp(s, ivec2(0), frame.strata - 1)).x;
}

#ifdef READS_CHANGE
#include "lib/counted_history.glsl"
#endif

float lambdaOfStrata(ivec2 p) {
    ivec2 s = p / int(kStratumSize);
    NOTE(lambdaStratum, s);
    if (LAMBDA_FETCH == kLambdaMax) {
        float largest = 0.0;
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
                float l = lambdaOf(s + ivec2(x, y));
                NOTE(lambdaStratum, l > lambdaOf(findings.lambdaStratum)
                                        ? clamp(s + ivec2(x, y), ivec2(0), frame.strata - 1)
                                        : findings.lambdaStratum);
                largest = max(largest, l);
            }
        return largest;
    }
    if (LAMBDA_FETCH == kLambdaBilinear) {
        // Centers of strata lie at 3 s + 3/2 in pixel coordinates.
        vec2 position = (vec2(p) + 0.5) / float(kStratumSize) - 0.5;
        ivec2 corner = ivec2(floor(position));
        vec2 f = position - vec2(corner);
        return mix(mix(lambdaOf(corner), lambdaOf(corner + ivec2(1, 0)), f.x),
                   mix(lambdaOf(corner + ivec2(0, 1)), lambdaOf(corner + ivec2(1, 1)), f.x), f.y);
    }
#ifdef READS_CHANGE
    if (LAMBDA_FETCH == kLambdaLight)
        return changeByLight(p).x;
#endif
    return lambdaOf(s);
}

float lambdaAt(ivec2 p, bool hasHistory, float historyLuminance) {
    if (LAMBDA_SOURCE == kLambdaFromGradient)
        return lambdaOfStrata(p);
    if (LAMBDA_SOURCE == kLambdaFromRange && hasHistory)
        return lambdaOfRange(p, historyLuminance);
    return 0.0;
}

float nextSamples(float samples, float alpha) {
    float next = samples + 1.0;
    if (HISTORY_LAW == kHistoryEffective)
        next = 1.0 / ((1.0 - alpha) * (1.0 - alpha) / samples + alpha * alpha);
    return min(next, params.maxHistory);
}

void main() {
    ivec2 p = texelToCompute();
    if (any(greaterThanEqual(p, frame.size)))
        return;
    vec4 guide = fetch(guides, p);
    vec4 current = fetch(raw, p);
    vec2 currentMoments = vec2(current.a, current.a * current.a);
    History history = fetchHistory(p, guide.xyz);
    NOTE(fetchedColor, history.color);
    NOTE(fetchedMoments, history.moments);
    NOTE(fetchedSamples, history.samples);

    bool hasHistory = history.samples > 0.0;
    float historyLuminance = hasHistory ? luminance(history.color) : 0.0;
    history.color = clampToNeighborhood(history.color, p);

    bool counts = LAMBDA_USE == kLambdaCounts;
    float fetchedLambda = counts ? 0.0 : lambdaAt(p, hasHistory, historyLuminance);
    float l = fetchedLambda;
    float newest = 1.0; // samples
#ifdef COUNTS
    if (counts) {
        if (history.isBetween)
            history.samples = min(history.samples, params.historyBetweenPixels);
        float before = history.samples;
        fetchedLambda = countChange(history, p);
        newest = newSamples(p, before, history.samples);
        l = 0.0;
    }
#endif
    if (LAMBDA_USE == kLambdaBlends && HISTORY_LAW == kHistoryPower)
        history.samples *= pow(1.0 - l, 10.0);
    if (LAMBDA_USE == kLambdaCuts) {
        float confidence = (1.0 - l) * (1.0 - l);
        // mix(confidence, 1, 1 / (N + 1)), in a form that is exactly 1 for a confidence of 1.
        history.samples *= confidence + (1.0 - confidence) / (history.samples + 1.0);
        l = 0.0;
    }
    float leastWeight = newest / (history.samples + newest);
    NOTE(usedColor, history.color);
    NOTE(usedSamples, history.samples);
    NOTE(leastWeight, leastWeight);
    NOTE(newSamples, newest);
    float alpha = (1.0 - l) * max(params.alpha, leastWeight) + l;
    float alphaMoments = (1.0 - l) * max(params.alphaMoments, leastWeight) + l;
    if (counts)
        alpha = leastWeight;
    if (!hasHistory)
        alpha = alphaMoments = 1.0;

    vec3 color = (1.0 - alpha) * history.color + alpha * current.rgb;
    vec2 blended = (1.0 - alphaMoments) * history.moments + alphaMoments * currentMoments;
    float length = counts ? min(history.samples + newest, params.maxHistory)
                          : nextSamples(history.samples, alpha);
    if (!hasHistory)
        length = 1.0;
    // The background is computed as well, and stored by one instruction with the rest: on llvmpipe
    // a second path costs more.
    bool isSurface = guide.w != 0.0;
    store(p, isSurface ? vec4(color, historyLuminance) : vec4(0.0),
          isSurface ? vec4(blended, length, 0.0) : vec4(0.0),
          isSurface ? vec4(fetchedLambda, alpha, length, float(history.reason)) : vec4(0.0));
}
