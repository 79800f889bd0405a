// SPDX-License-Identifier: MIT
#include "app/workbench/camera_path.h"

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
