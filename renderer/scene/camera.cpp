// SPDX-License-Identifier: MIT
#include "renderer/scene/camera.h"

#include <cmath>

namespace afterglow {

glm::mat4 Camera::viewFromWorld() const {
    // The inverse of a rotation is its transpose: no general inverse, so no loss of precision.
    const glm::mat3 viewFromWorldRotation = glm::transpose(glm::mat3_cast(orientation));
    glm::mat4 view(viewFromWorldRotation);
    view[3] = glm::vec4(viewFromWorldRotation * -position, 1.0f);
    return view;
}

glm::mat4 Camera::clipFromView(float aspect) const {
    const float focal = 1.0f / std::tan(lens.verticalFov * 0.5f);
    glm::mat4 clip(0.0f);
    clip[0][0] = focal / aspect;
    clip[1][1] = focal;
    clip[2][3] = -1.0f; // clip w is the distance in front of the camera
    // depth = (a * viewZ + b) / -viewZ with depth(-near) = 1 and depth(-far) = 0. For an infinite
    // far plane a is 0 and b is near.
    if (std::isinf(lens.far)) {
        clip[3][2] = lens.near;
    } else {
        const float a = lens.near / (lens.far - lens.near);
        clip[2][2] = a;
        clip[3][2] = a * lens.far;
    }
    return clip;
}

Camera lookAt(glm::vec3 eye, glm::vec3 target, Lens lens) {
    Camera camera;
    camera.position = eye;
    camera.lens = lens;
    const glm::vec3 toward = target - eye;
    if (glm::length(toward) == 0.0f) {
        return camera;
    }
    const glm::vec3 back = -glm::normalize(toward);
    // Straight up or down has no upright: any direction to the side will do.
    const glm::vec3 side = glm::cross(glm::vec3(0.0f, 1.0f, 0.0f), back);
    const glm::vec3 right =
        glm::length(side) > 1e-6f ? glm::normalize(side) : glm::vec3(1.0f, 0.0f, 0.0f);
    camera.orientation =
        glm::normalize(glm::quat_cast(glm::mat3(right, glm::cross(back, right), back)));
    return camera;
}

} // namespace afterglow
