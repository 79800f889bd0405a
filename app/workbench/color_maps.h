// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

namespace afterglow {

/// The scales of shaders/lib/false_color.glsl for legends: sRGB-encoded colors in [0, 1].
glm::vec3 scalarColor(float t); ///< t in [0, 1]
glm::vec3 signedColor(float t); ///< t in [-1, 1]

} // namespace afterglow
