// SPDX-License-Identifier: MIT
// Exposed linear radiance, not negative, to linear light of the display in [0, 1]. TONE_MAPPER says
// which of them toneMap() is.

#include "shared/post_params.h"

#ifndef TONE_MAPPER
#define TONE_MAPPER kToneAces
#endif

// The rational fit of Narkowicz 2015, "ACES Filmic Tone Mapping Curve", per channel.
vec3 toneMapAces(vec3 x) {
    return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

// After Sobotka's AgX (2022): mixed channels, a sigmoid over stops, channels unmixed. The mixture
// is that of Wrensch 2023, "Minimal AgX Implementation". Departure: the sigmoid is a formula, where
// AgX has a table and Wrensch a polynomial; it is within 0.006 of that polynomial.
const mat3 kAgxMixed = mat3(0.842479, 0.0423282, 0.0423757, // columns
                            0.0784336, 0.878469, 0.0784336, //
                            0.0792237, 0.0791661, 0.879143);
const mat3 kAgxUnmixed = mat3(1.1968791, -0.052896772, -0.052971707, // its inverse
                              -0.098020853, 1.1519026, -0.0980434,   //
                              -0.099029693, -0.098961104, 1.1510736);
const float kAgxDarkest = -12.473931; // log2(0.18) - 10
const float kAgxStops = 16.5;
const float kAgxPivot = 10.0 / 16.5; // middle gray's place among the stops, which becomes 1/2
const float kAgxSlope = 2.0;         // there
const float kAgxToe = 3.0, kAgxShoulder = 3.25;

// Rises with kAgxSlope from 0, and is 1/2 at d = `end`.
vec3 agxHalf(vec3 d, float end, float power) {
    float bend = (pow(2.0 * kAgxSlope * end, power) - 1.0) / pow(end, power);
    return kAgxSlope * d / pow(1.0 + bend * pow(d, vec3(power)), vec3(1.0 / power));
}

vec3 toneMapAgx(vec3 x) {
    vec3 stops = log2(max(kAgxMixed * x, exp2(kAgxDarkest)));
    vec3 place = clamp((stops - kAgxDarkest) / kAgxStops, 0.0, 1.0);
    vec3 encoded = 0.5 + agxHalf(max(place - kAgxPivot, 0.0), 1.0 - kAgxPivot, kAgxShoulder) -
                   agxHalf(max(kAgxPivot - place, 0.0), kAgxPivot, kAgxToe);
    return pow(clamp(kAgxUnmixed * encoded, 0.0, 1.0), vec3(2.2));
}

// Khronos 2024, "PBR Neutral Tone Mapper": colors stay as they are but for the reflection of 4 % of
// a dielectric; what is brighter than kNeutralStart is compressed and loses saturation.
const float kNeutralReflection = 0.04;
const float kNeutralStart = 0.8 - kNeutralReflection;
const float kNeutralDesaturation = 0.15;

vec3 toneMapNeutral(vec3 x) {
    float least = min(min(x.r, x.g), x.b);
    float offset = least < 2.0 * kNeutralReflection
                       ? least - least * least / (4.0 * kNeutralReflection)
                       : kNeutralReflection;
    vec3 color = x - offset;
    float peak = max(max(color.r, color.g), color.b);
    float room = 1.0 - kNeutralStart;
    float compressed = 1.0 - room * room / (max(peak, kNeutralStart) + room - kNeutralStart);
    float gray = 1.0 - 1.0 / (kNeutralDesaturation * (max(peak, kNeutralStart) - compressed) + 1.0);
    vec3 bright = mix(color * (compressed / max(peak, kNeutralStart)), vec3(compressed), gray);
    return clamp(peak < kNeutralStart ? color : bright, 0.0, 1.0);
}

vec3 toneMap(vec3 x) {
    if (TONE_MAPPER == kToneAgx)
        return toneMapAgx(x);
    if (TONE_MAPPER == kToneNeutral)
        return toneMapNeutral(x);
    return TONE_MAPPER == kToneAces ? toneMapAces(x) : clamp(x, 0.0, 1.0);
}
