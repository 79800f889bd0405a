// SPDX-License-Identifier: MIT
#include "app/workbench/camera_flight.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace afterglow {
namespace {

// Uniform Catmull-Rom: through b and c, with a before and d after.
glm::vec3 between(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, float t) {
    return 0.5f * ((2.0f * b) + (c - a) * t + (2.0f * a - 5.0f * b + 4.0f * c - d) * t * t +
                   (3.0f * b - a - 3.0f * c + d) * t * t * t);
}

} // namespace

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

Camera onPath(std::span<const Camera> keys, double seconds) {
    const double place = seconds / kSecondsPerKey;
    const auto leg = std::int64_t(std::floor(place));
    const float t = float(place - double(leg));
    const auto n = std::int64_t(keys.size());
    const auto key = [&](std::int64_t i) -> const Camera& {
        return keys[std::size_t((((leg + i) % n) + n) % n)];
    };
    Camera camera = key(0);
    camera.position =
        between(key(-1).position, key(0).position, key(1).position, key(2).position, t);
    const float eased = t * t * (3.0f - 2.0f * t); // it turns slowly where it changes its mind
    camera.orientation = glm::normalize(glm::slerp(key(0).orientation, key(1).orientation, eased));
    camera.lens.verticalFov = glm::mix(key(0).lens.verticalFov, key(1).lens.verticalFov, eased);
    return camera;
}

std::vector<Camera> swayAround(const Camera& home, float distance) {
    const glm::vec3 target = home.position + distance * home.forward();
    const glm::vec3 right = home.orientation * glm::vec3(1.0f, 0.0f, 0.0f);
    const glm::vec3 up{0.0f, 1.0f, 0.0f};
    std::vector<Camera> keys;
    for (const glm::vec2 place :
         {glm::vec2(0.0f, 0.0f), {0.22f, 0.03f}, {0.0f, 0.06f}, {-0.22f, 0.03f}}) {
        const glm::vec3 eye = home.position + distance * (place.x * right + place.y * up);
        keys.push_back(lookAt(eye, target, home.lens));
    }
    keys.front() = home;
    return keys;
}

} // namespace afterglow
