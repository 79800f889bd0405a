// SPDX-License-Identifier: MIT
#pragma once
#include "shared/interop.h"
SHARED_BEGIN

// The scene as arrays of 16-byte texels; see renderer/resources/scene_gpu.h.
// GLSL reads them by kTexelsPer... and the order of members below.

struct Vertex {    // also the vertex buffer of the raster pass
    vec3 position; // meters, object
    float u;
    vec3 normal; // unit length, object
    float v;
};
const uint kTexelsPerVertex = 2u;

struct InstanceRecord {
    vec4 worldFromObject[3];         // rows of the affine transform
    vec4 previousWorldFromObject[3]; // one frame before
    uint firstTriangle;              // index of the mesh's first triangle in `triangles`
    uint material;
    uint light;              // slot, or kNoLight
    uint firstLightTriangle; // of a light: its first triangle's index in `lightTriangles`
};
const uint kTexelsPerInstance = 7u;
const uint kNoLight = 0xffffffffu;

struct MaterialRecord {
    vec3 baseColor;
    float metallic;
    vec3 emission; // radiance with the light switched on
    float roughness;
};
const uint kTexelsPerMaterial = 2u;

// One emissive triangle in world space. The nominal power of the whole scene's lights makes the
// distribution; it never depends on what is switched on.
struct LightTriangle {
    vec3 corner;
    float cumulative; // probability of this triangle and all before it; 1 at the last
    vec3 edge1;       // corner to the second vertex
    float probability;
    vec3 edge2;    // corner to the third vertex
    uint light;    // slot
    vec3 emission; // radiance with the light switched on
    uint doubleSided;
};
const uint kTexelsPerLightTriangle = 4u;

SHARED_END
