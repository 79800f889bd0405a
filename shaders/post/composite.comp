#version 450 core
// SPDX-License-Identifier: MIT

// Puts back what the filters must not touch: emission, background, and what each signal was divided
// by. SIGNALS says how many there are.

#include "lib/fetch.glsl"
#include "lib/frame.glsl"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;

Float4Texture(signal0);
Float4Texture(demodulation0);
#if SIGNALS > 1
Float4Texture(signal1);
Float4Texture(demodulation1);
#endif
Float4Texture(emission);
Float4Texture(guides);

writeonly uniform image2D composed; // linear radiance

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, frame.size)))
        return;
    vec3 radiance = fetch(demodulation0, p).rgb * fetch(signal0, p).rgb + fetch(emission, p).rgb;
#if SIGNALS > 1
    radiance += fetch(demodulation1, p).rgb * fetch(signal1, p).rgb;
#endif
    if (fetch(guides, p).w == 0.0)
        radiance = frame.ambient;
    imageStore(composed, p, vec4(radiance, 1.0));
}
