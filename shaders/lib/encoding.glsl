// SPDX-License-Identifier: MIT
// Unit vectors in 32 bits: octahedral map, two signed normalized 16-bit numbers.
// Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors".

vec2 signNotZero(vec2 v) {
    return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0);
}

uint octEncode(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    if (n.z < 0.0)
        p = (1.0 - abs(p.yx)) * signNotZero(p);
    return packSnorm2x16(p);
}

vec3 octDecode(uint bits) {
    vec2 p = unpackSnorm2x16(bits);
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (n.z < 0.0)
        n.xy = (1.0 - abs(n.yx)) * signNotZero(n.xy);
    return normalize(n);
}

// A pixel, or a stratum, of a picture of at most 65,536 x 65,536.
uint packPixel(ivec2 p) {
    return uint(p.x) | (uint(p.y) << 16);
}

ivec2 unpackPixel(uint place) {
    return ivec2(place & 0xffffu, place >> 16);
}
