#version 450 core
// SPDX-License-Identifier: MIT

// Turns rasterized ids into visibility samples (with the barycentrics of the place
// in the pixel at which this frame looks) and
// gives every pixel its own seed. Forward projection may then replace some of both.

#include "lib/frame.glsl"
#include "lib/geometry.glsl"
#include "lib/seed.glsl"
#include "lib/view.glsl"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;

Uint2Texture(ids);
writeonly uniform uimage2D visibility;
writeonly uniform uimage2D seeds;

// Where the ray from the camera meets the triangle's plane, kept inside the triangle: rasterization
// snaps corners to a fraction of a pixel, so the ray may pass its edge by that much.
vec2 barycentricsAt(Triangle t, vec3 direction) {
    vec3 s = frame.cameraPosition - t.corner;
    vec3 across = cross(direction, t.edge2);
    float det = dot(t.edge1, across);
    if (det == 0.0)
        return vec2(1.0 / 3.0);
    vec2 b = vec2(dot(s, across), dot(direction, cross(s, t.edge1))) / det;
    b = clamp(b, 0.0, 1.0);
    return b / max(1.0, b.x + b.y);
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, frame.size)))
        return;
    imageStore(seeds, p, uvec4(newSeed(p, frame.sampleIndex)));
    uvec2 id = fetch(ids, p).xy;
    if (id.x == 0u) {
        imageStore(visibility, p, uvec4(0u));
        return;
    }
    Affine m = instanceTransform(id.x - 1u, false);
    Triangle t = worldTriangle(triangleVertices(id.x - 1u, id.y), m);
    vec2 b = barycentricsAt(t, worldRay(vec2(p) + 0.5 + frame.jitter));
    imageStore(visibility, p, uvec4(id, floatBitsToUint(b)));
}
