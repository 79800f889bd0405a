// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/scene/shapes.h"

namespace afterglow::test {

/// Returns the value of a rotation track's key: a turn about an axis, radians.
inline glm::vec4 turn(glm::vec3 axis, float angle) {
    const glm::quat q = glm::angleAxis(angle, glm::normalize(axis));
    return {q.x, q.y, q.z, q.w};
}

/// Returns a level square around the origin, its front up (1) or down (-1).
inline Mesh square(float half, float front) {
    Mesh mesh;
    addQuadFacing(mesh, {0.0f, front, 0.0f}, {-half, 0, -half}, {half, 0, -half}, {half, 0, half},
                  {-half, 0, half});
    return mesh;
}

} // namespace afterglow::test
