// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/image/image.h"

namespace afterglow {

/// Returns the albedo of a GGX lobe over roughness (x) and the cosine of the view (y), as the two
/// terms of F0 A + B with Schlick's Fresnel: docs/pipeline.md, "Paths". kAlbedoTableSize along each
/// edge, from 0 to 1 with both ends. Throws nothing; runs on all threads.
Image<glm::vec2> makeSpecularAlbedo();

} // namespace afterglow
