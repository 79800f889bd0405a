#version 450 core
// SPDX-License-Identifier: MIT

// The normalized history weight. Schied et al. 2018, section 4.4: lambda = min(1, |delta| / Delta),
// normalized once, after the reconstruction, so that empty strata do not bias it.

#include "lib/fetch.glsl"
#include "shared/bindings.h"
#include "shared/denoise_params.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;
layout(std140, binding = kPassBlock) uniform Params {
    GradientParams params;
};

Float4Texture(gradient);
writeonly uniform image2D lambda;

void main() {
    ivec2 s = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(s, sizeOf(gradient))))
        return;
    vec2 change = fetch(gradient, s).xy;
    float value = change.y > params.deltaFloor ? min(1.0, abs(change.x) / change.y) : 0.0;
    imageStore(lambda, s, vec4(params.forceLambda >= 0.0 ? params.forceLambda : value));
}
