#version 450 core

// Puts back what the filter must not touch: albedo, emission, background.

#include "lib/fetch.glsl"
#include "lib/frame.glsl"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;

Float4Texture(signal);
Float4Texture(albedo);
Float4Texture(emission);
Float4Texture(guides);

writeonly uniform image2D composed; // linear radiance

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, frame.size)))
        return;
    vec3 radiance = fetch(albedo, p).rgb * fetch(signal, p).rgb + fetch(emission, p).rgb;
    if (fetch(guides, p).w == 0.0)
        radiance = frame.ambient;
    imageStore(composed, p, vec4(radiance, 1.0));
}
