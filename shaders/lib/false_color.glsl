// SPDX-License-Identifier: MIT
// Colors for numbers. app/workbench/color_maps.cpp draws the same scales as legends.

#include "lib/color.glsl"
#include "shared/debug_view_params.h"

// Ottosson 2020, "A perceptual color space for image processing": OKLab to linear Rec. 709.
vec3 fromOklab(vec3 lab) {
    vec3 root = vec3(lab.x + 0.3963377774 * lab.y + 0.2158037573 * lab.z,
                     lab.x - 0.1055613458 * lab.y - 0.0638541728 * lab.z,
                     lab.x - 0.0894841775 * lab.y - 1.2914855480 * lab.z);
    vec3 lms = root * root * root;
    return vec3(dot(lms, vec3(4.0767416621, -3.3077115913, 0.2309699292)),
                dot(lms, vec3(-1.2684380046, 2.6097574011, -0.3413193965)),
                dot(lms, vec3(-0.0041960863, -0.7034186147, 1.7076147010)));
}

vec3 fromPolar(float lightness, float chroma, float degrees) {
    float h = radians(degrees);
    return fromOklab(vec3(lightness, chroma * cos(h), chroma * sin(h)));
}

// t in [0, 1]: lightness rises evenly while the hue walks from violet over teal to yellow; the
// chroma is as large as the gamut allows on that path.
vec3 scalarColor(float t) {
    float t2 = t * t;
    float chroma = 0.105 + 0.035 * cos(6.2831853 * t) + 0.03 * t2 * t2;
    return fromPolar(0.20 + 0.72 * t, chroma, 300.0 - 195.0 * t);
}

// t in [-1, 1]: equally light on both sides of the dark zero.
vec3 signedColor(float t) {
    float a = abs(t);
    float chroma = a > 0.0 ? 0.13 * pow(a, 0.8) * (1.0 - 0.25 * a * a) : 0.0;
    return fromPolar(0.22 + 0.62 * a, chroma, t < 0.0 ? 250.0 : 58.0);
}

// v with a length of at most 1: right is red, up green, left cyan-blue, down violet.
vec3 directionColor(vec2 v) {
    float size = min(length(v), 1.0);
    float hue = size > 0.0 ? degrees(atan(-v.y, v.x)) : 0.0;
    return fromPolar(0.20 + 0.55 * size, 0.11 * size, hue + 25.0);
}

// Neighboring numbers get hues far apart: steps of the golden angle.
vec3 numberColor(uint n) {
    if (n == 0u)
        return vec3(0.01);
    return fromPolar(0.62 + 0.07 * float(n % 3u), 0.10, mod(float(n % 360u) * 137.50776, 360.0));
}

vec3 toDisplay(vec3 color) {
    return encodeSrgb(clamp(color, 0.0, 1.0));
}
