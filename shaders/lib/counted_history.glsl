// SPDX-License-Identifier: MIT
// A history that is a mean of samples, from which changes of light take some away: "Counted
// history" in docs/pipeline.md. Part of denoise/temporal.comp, whose inputs and parameters it
// reads.

// Weights of the 3x3 strata around by their distance; they need no sum of 1.
const float kNear[2] = float[](2.0, 1.0);
const float kMostStillStrata = 0.005; // of all: more that change are a change of the picture

// Returns what is left of lambda^2, variance of a sample, factor, weight.
vec4 changeOf(ivec2 s) {
    return fetch(change, clamp(s, ivec2(0), frame.strata - 1));
}

// Returns lambda, and with it what is left of its square, of the strata around by their light.
vec2 changeByLight(ivec2 p) {
    ivec2 s = p / int(kStratumSize);
    vec2 sum = vec2(0.0);
    float weightSum = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            vec4 c = changeOf(s + ivec2(x, y));
            float weight = kNear[abs(x)] * kNear[abs(y)] * c.w;
            sum += weight * vec2(lambdaOf(s + ivec2(x, y)), c.x);
            weightSum += weight;
        }
    return weightSum > 0.0 ? sum / weightSum : vec2(0.0);
}

struct LightChange {
    float lambda;
    float left;     // E: squared relative bias that is left after the history was scaled
    float variance; // v: relative, of one sample
    float scale;
};

LightChange lightChangeAt(ivec2 p) {
    ivec2 s = p / int(kStratumSize);
    // Centers of strata lie at 3 s + 3/2 in pixel coordinates.
    vec2 position = (vec2(p) + 0.5) / float(kStratumSize) - 0.5;
    ivec2 corner = ivec2(floor(position));
    vec2 f = position - vec2(corner);
    float variance = 0.0, scale = 0.0, scaleWeight = 0.0;
    vec2 bilinear = vec2(0.0), largest = vec2(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 place = ivec2(i & 1, i >> 1);
        float weight = (place.x == 1 ? f.x : 1.0 - f.x) * (place.y == 1 ? f.y : 1.0 - f.y);
        vec4 c = changeOf(corner + place);
        variance += weight * c.y;
        scale += weight * c.w * c.z;
        scaleWeight += weight * c.w;
        if (LAMBDA_FETCH == kLambdaBilinear)
            bilinear += weight * vec2(lambdaOf(corner + place), c.x);
    }
    scale = scaleWeight > 0.0 ? scale / scaleWeight : 1.0;

    NOTE(lambdaStratum, s);
    vec2 fetched = vec2(lambdaOf(s), changeOf(s).x);
    if (LAMBDA_FETCH == kLambdaBilinear)
        fetched = bilinear;
    if (LAMBDA_FETCH == kLambdaLight)
        fetched = changeByLight(p);
    if (LAMBDA_FETCH == kLambdaMax)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x)
                fetched =
                    max(fetched, vec2(lambdaOf(s + ivec2(x, y)), changeOf(s + ivec2(x, y)).x));
    return LightChange(fetched.x, fetched.y, clamp(variance, 0.05, 4.0), scale);
}

#ifdef COUNTS

// Takes from the history what is known to have changed; returns lambda.
float countChange(inout History history, ivec2 p) {
    uint strata = fetch(changed, ivec2(0)).x;
    if (strata == 0u || history.samples == 0.0)
        return 0.0;
    LightChange c = lightChangeAt(p);
    NOTE(change, vec4(c.left, c.variance, c.scale, float(strata)));
    if (float(strata) > kMostStillStrata * float(frame.strata.x * frame.strata.y))
        history.samples = min(history.samples, params.historyDuringChange);
    if (c.lambda > 0.0) {
        history.color *= c.scale;
        history.moments *= vec2(c.scale, c.scale * c.scale);
    }
    history.samples /=
        1.0 + history.samples * params.reactivity * c.left / ((1.0001 - c.lambda) * c.variance);
    return c.lambda;
}

// Returns how much of a new sample the newest one is. `before` and `after` the change: samples in
// the history.
float newSamples(ivec2 p, float before, float after) {
    ivec2 inStratum = p % int(kStratumSize);
    uint place = uint(inStratum.x) + kStratumSize * uint(inStratum.y);
    bool isReused = fetch(samples, p / int(kStratumSize)).y == place + 1u;
    return params.countReusedOnce != 0 && isReused && before > 0.0 ? 1.0 - after / before : 1.0;
}

#endif
