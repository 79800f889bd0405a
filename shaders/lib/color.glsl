// SPDX-License-Identifier: MIT
// Luminance of linear Rec. 709 radiance.
float luminance(vec3 c) {
    return dot(c, vec3(0.2126, 0.7152, 0.0722));
}

// Linear to encoded, both in [0, 1]. IEC 61966-2-1.
vec3 encodeSrgb(vec3 linear) {
    return mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055,
               greaterThan(linear, vec3(0.0031308)));
}
