// SPDX-License-Identifier: MIT
#pragma once
#include "shared/interop.h"
SHARED_BEGIN

// Paths of two segments: docs/pipeline.md, "Paths".
const uint kAlbedoTableSize = 32u;   // entries over roughness, and over the cosine
const float kLeastAlpha = 1e-3f;     // of GGX
const float kLeastCosine = 1e-3f;    // of a normal with the direction to the viewer
const float kDielectricF0 = 0.04f;   // an index of refraction of 1.5
const float kMirrorRoughness = 0.3f; // glTF; above it reflections move with their surface
const float kFlatMirror = 0.9995f;   // least cosine between the normals of a flat mirror's pixels
const float kLeastDivisor = 1e-3f;   // of a signal

// Which parts of the light make which signal.
const uint kPathWhole = 0u;    // one signal
const uint kPathLobes = 1u;    // diffuse; specular
const uint kPathSegments = 2u; // what x1 gets from emitters; what it gets from other surfaces

SHARED_END
