#version 450 core
// SPDX-License-Identifier: MIT

// Normal, depth and slope of each stratum, for filters on the grid of strata: those of its center
// pixel, or of its first pixel with a surface where the center shows none.

#include "lib/fetch.glsl"
#include "shared/bindings.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;

Float4Texture(guides);
Float2Texture(slope);

writeonly uniform image2D strataGuides;
writeonly uniform image2D strataSlope;

void main() {
    ivec2 s = ivec2(gl_GlobalInvocationID.xy);
    ivec2 first = s * int(kStratumSize);
    ivec2 last = sizeOf(guides) - 1;
    if (any(greaterThan(first, last)))
        return;
    ivec2 chosen = min(first + 1, last);
    bool found = fetch(guides, chosen).w != 0.0;
    for (int i = 0; i < 9 && !found; ++i) {
        ivec2 p = first + ivec2(i % 3, i / 3);
        if (any(greaterThan(p, last)) || fetch(guides, p).w == 0.0)
            continue;
        chosen = p;
        found = true;
    }
    imageStore(strataGuides, s, found ? fetch(guides, chosen) : vec4(0.0));
    imageStore(strataSlope, s, found ? vec4(fetch(slope, chosen).xy, 0.0, 0.0) : vec4(0.0));
}
