// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

namespace afterglow {

/// How one light of a scene is set. It multiplies the light's own emission.
struct LightState {
    bool on = true;
    float power = 1.0f;   ///< >= 0; 1: as the scene has it
    glm::vec3 tint{1.0f}; ///< linear color factors, >= 0

    /// What the light's radiance is multiplied by.
    glm::vec3 scale() const { return on ? power * tint : glm::vec3(0.0f); }

    bool operator==(const LightState&) const = default;
};

} // namespace afterglow
