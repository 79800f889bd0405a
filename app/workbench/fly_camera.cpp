// SPDX-License-Identifier: MIT
#include "app/workbench/fly_camera.h"

#include <algorithm>
#include <cmath>

namespace afterglow {

void fly(Camera& camera, const FlyInput& input, float metresPerSecond, double seconds) {
    constexpr glm::vec3 up{0.0f, 1.0f, 0.0f};
    constexpr float highest = 1.55f; // radians, just under a right angle

    const float pitch = std::asin(std::clamp(camera.forward().y, -1.0f, 1.0f));
    const float wanted =
        std::clamp(pitch + input.look.y, std::min(-highest, pitch), std::max(highest, pitch));
    camera.orientation =
        glm::normalize(glm::angleAxis(-input.look.x, up) * camera.orientation *
                       glm::angleAxis(wanted - pitch, glm::vec3(1.0f, 0.0f, 0.0f)));

    glm::vec3 move = input.move;
    if (const float length = glm::length(move); length > 1.0f)
        move /= length;
    const float distance =
        metresPerSecond * (input.fast ? kFastFactor : 1.0f) * static_cast<float>(seconds);
    const glm::vec3 right = camera.orientation * glm::vec3(1.0f, 0.0f, 0.0f);
    camera.position += distance * (move.x * right + move.y * up + move.z * camera.forward());
}

float defaultSpeed(float extent) {
    return std::max(0.06f * extent, 1e-3f); // through the scene in a quarter of a minute
}

float changedSpeed(float metresPerSecond, float notches, float extent) {
    const float standard = defaultSpeed(extent);
    return std::clamp(metresPerSecond * std::pow(1.2f, notches), standard / 50.0f,
                      standard * 50.0f);
}

} // namespace afterglow
