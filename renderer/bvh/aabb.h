// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include <glm/glm.hpp>

namespace afterglow {

/// An axis-aligned box. It starts empty: nothing is inside, and including a point makes it that
/// point.
struct Aabb {
    glm::vec3 min{std::numeric_limits<float>::infinity()};
    glm::vec3 max{-std::numeric_limits<float>::infinity()};

    void include(glm::vec3 p) {
        min = glm::min(min, p);
        max = glm::max(max, p);
    }
    void include(const Aabb& other) {
        min = glm::min(min, other.min);
        max = glm::max(max, other.max);
    }
    bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
    bool contains(const Aabb& other) const {
        return glm::all(glm::lessThanEqual(min, other.min)) &&
               glm::all(glm::greaterThanEqual(max, other.max));
    }
};

} // namespace afterglow
