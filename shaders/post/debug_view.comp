#version 450 core
// SPDX-License-Identifier: MIT

// Shows what any image of a frame holds. SOURCE says how the image is declared: Float4Texture and
// so on; SOURCE_IS_INTEGER where it holds integers.

#include "lib/false_color.glsl"
#include "lib/fetch.glsl"
#include "shared/bindings.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;
layout(std140, binding = kPassBlock) uniform Params {
    DebugViewParams params;
};

SOURCE(source);
writeonly uniform image2D display;

const vec3 kNotANumber = vec3(1.0, 0.0, 1.0);

vec4 valueAt(ivec2 p) {
#ifdef SOURCE_IS_INTEGER
    uvec4 texel = fetch(source, p);
    return params.isFloatBits != 0 ? uintBitsToFloat(texel) : vec4(texel);
#else
    return fetch(source, p);
#endif
}

// Where x lies between low and high, in [0, 1].
vec3 within(vec3 x) {
    return clamp((x - params.low) / max(params.high - params.low, 1e-20), 0.0, 1.0);
}

vec3 colorOf(vec4 value) {
    float x = value[params.channel];
    switch (params.map) {
    case kMapRadiance: return value.rgb / params.high;
    case kMapScalar: return scalarColor(within(vec3(x)).x);
    case kMapLogarithm: {
        float range = max(log(params.high / params.low), 1e-20);
        return scalarColor(clamp(log(max(x, params.low) / params.low) / range, 0.0, 1.0));
    }
    case kMapSigned: return signedColor(clamp(x / params.high, -1.0, 1.0));
    case kMapVector: return pow(within(value.rgb), vec3(2.2));
    case kMapRepeat: return pow(fract(value.rgb / params.high), vec3(2.2));
    case kMapDirection: return directionColor(value.xy / params.high);
    }
    return numberColor(uint(max(x, 0.0)));
}

bool isShown(vec4 value) {
    bvec4 bad = bvec4(uvec4(isnan(value)) | uvec4(isinf(value)));
    switch (params.map) {
    case kMapRadiance:
    case kMapVector:
    case kMapRepeat: return !any(bad.rgb);
    case kMapDirection: return !any(bad.rg);
    }
    return !bad[params.channel];
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, imageSize(display))))
        return;
    ivec2 texel = min(p / params.pixelsPerTexel, sizeOf(source) - 1);
    vec4 value = valueAt(texel);
    imageStore(display, p, vec4(toDisplay(isShown(value) ? colorOf(value) : kNotANumber), 1.0));
}
