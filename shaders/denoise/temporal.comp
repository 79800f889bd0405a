#version 450 core

// Back-projects the history and blends the new sample into it, with an alpha for each pixel.
// Schied et al. 2017, section 4.1; Schied et al. 2018, section 4.4.
// Departure: the history length is the effective number of samples, which falls with alpha; the
// papers leave it as it is, and alpha then returns to its least value with a history of one sample.

#include "lib/fetch.glsl"
#include "lib/frame.glsl"
#include "shared/denoise_params.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;
layout(std140, binding = kPassBlock) uniform Params {
    TemporalParams params;
};

Float4Texture(raw); // a: luminance
Uint4Texture(visibility);
Uint4Texture(previousVisibility);
Float4Texture(guides);
Float4Texture(previousGuides);
Float2Texture(slope);
Float4Texture(motion);
Float4Texture(previousColor);
Float4Texture(previousMoments);
FloatTexture(lambda); // per stratum

writeonly uniform image2D accumulated;
writeonly uniform image2D moments;
writeonly uniform image2D control; // lambda, alpha, history length, reason

struct History {
    vec3 color;
    vec2 moments;
    float samples; // effective number; 0: none
    int reason;
};

const float kLeastWeight = 0.01;   // of the valid taps together
const float kDepthEpsilon = 0.005; // of the depth

int tapReason(ivec2 q, uint instance, float depth, float tolerance, vec3 normal) {
    if (any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, frame.size)))
        return kHistoryOffScreen;
    if (fetch(previousVisibility, q).x != instance)
        return kHistoryInstance;
    vec4 guide = fetch(previousGuides, q);
    if (abs(guide.w - depth) > tolerance)
        return kHistoryDepth;
    return dot(guide.xyz, normal) >= params.normalTolerance ? kHistoryKept : kHistoryNormal;
}

History fetchHistory(ivec2 p, vec3 normal) {
    History none = History(vec3(0.0), vec2(0.0), 0.0, kHistoryNone);
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

    History history = none;
    float weightSum = 0.0, largest = -1.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 place = ivec2(i & 1, i >> 1);
        ivec2 q = corner + place;
        float weight = (place.x == 1 ? f.x : 1.0 - f.x) * (place.y == 1 ? f.y : 1.0 - f.y);
        int reason = tapReason(q, instance, moved.z, tolerance, normal);
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
    if (weightSum < kLeastWeight)
        return History(vec3(0.0), vec2(0.0), 0.0, history.reason);
    history.color /= weightSum;
    history.moments /= weightSum;
    history.samples /= weightSum;
    history.reason = kHistoryKept;
    return history;
}

float lambdaOf(ivec2 s) {
    return fetch(lambda, clamp(s, ivec2(0), frame.strata - 1)).x;
}

float lambdaAt(ivec2 p) {
    if (params.useLambda == 0)
        return 0.0;
    ivec2 s = p / int(kStratumSize);
    if (params.lambdaFetch == kLambdaMax) {
        float largest = 0.0;
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x)
                largest = max(largest, lambdaOf(s + ivec2(x, y)));
        return largest;
    }
    if (params.lambdaFetch == kLambdaBilinear) {
        // Centres of strata lie at 3 s + 3/2 in pixel coordinates.
        vec2 position = (vec2(p) + 0.5) / float(kStratumSize) - 0.5;
        ivec2 corner = ivec2(floor(position));
        vec2 f = position - vec2(corner);
        return mix(mix(lambdaOf(corner), lambdaOf(corner + ivec2(1, 0)), f.x),
                   mix(lambdaOf(corner + ivec2(0, 1)), lambdaOf(corner + ivec2(1, 1)), f.x), f.y);
    }
    return lambdaOf(s);
}

float nextSamples(float samples, float alpha, float l) {
    if (samples == 0.0)
        return 1.0;
    float next = 1.0 / ((1.0 - alpha) * (1.0 - alpha) / samples + alpha * alpha);
    if (params.historyLaw == kHistoryFrames)
        next = samples + 1.0;
    if (params.historyLaw == kHistoryPower)
        next = samples * pow(1.0 - l, 10.0) + 1.0;
    return min(next, params.maxHistory);
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, frame.size)))
        return;
    vec4 guide = fetch(guides, p);
    if (guide.w == 0.0) {
        imageStore(accumulated, p, vec4(0.0));
        imageStore(moments, p, vec4(0.0));
        imageStore(control, p, vec4(0.0));
        return;
    }

    vec4 current = fetch(raw, p);
    vec2 currentMoments = vec2(current.a, current.a * current.a);
    History history = fetchHistory(p, guide.xyz);

    float l = lambdaAt(p);
    float leastWeight = 1.0 / (history.samples + 1.0);
    float alpha = (1.0 - l) * max(params.alpha, leastWeight) + l;
    float alphaMoments = (1.0 - l) * max(params.alphaMoments, leastWeight) + l;
    if (history.samples == 0.0)
        alpha = alphaMoments = 1.0;

    vec3 color = (1.0 - alpha) * history.color + alpha * current.rgb;
    vec2 blended = (1.0 - alphaMoments) * history.moments + alphaMoments * currentMoments;
    float samples = nextSamples(history.samples, alpha, l);
    imageStore(accumulated, p, vec4(color, 0.0));
    imageStore(moments, p, vec4(blended, samples, 0.0));
    imageStore(control, p, vec4(l, alpha, samples, float(history.reason)));
}
