// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace afterglow {

/// The lens of a pinhole camera.
struct Lens {
    float verticalFov = 0.9f;                           ///< radians, in (0, pi)
    float near = 0.05f;                                 ///< meters, > 0
    float far = std::numeric_limits<float>::infinity(); ///< meters, > near; infinity is allowed

    bool operator==(const Lens&) const = default; ///< to the last bit
};

/// The place, direction and lens of a camera. Right-handed, Y up; it looks along its -Z.
struct Camera {
    glm::vec3 position{0.0f};                      ///< meters, world
    glm::quat orientation{1.0f, 0.0f, 0.0f, 0.0f}; ///< worldFromCamera rotation, unit length
    Lens lens;

    glm::vec3 forward() const { return orientation * glm::vec3(0.0f, 0.0f, -1.0f); }
    glm::mat4 viewFromWorld() const;

    /// Returns the projection to clip space, with reversed depth in [0, 1]: 1 at the near plane, 0
    /// at the far plane (or at infinity). Clip y points up; the rasterizer's origin is the upper
    /// left corner (glClipControl).
    glm::mat4 clipFromView(float aspect) const;

    bool operator==(const Camera&) const = default; ///< to the last bit
};

/// Returns a camera at `eye` that looks at `target`, upright.
Camera lookAt(glm::vec3 eye, glm::vec3 target, Lens lens = {});

} // namespace afterglow
