// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/scene/camera.h"

#include <span>
#include <vector>

namespace afterglow {

/// The flight that is asked of a camera in one frame.
struct FlyInput {
    glm::vec3 move{0.0f}; ///< right, up, forward; each in [-1, 1]
    glm::vec2 look{0.0f}; ///< radians to the right and up
    bool fast = false;
};

constexpr float kFastFactor = 4.0f;

/// Moves along the camera's own axes (up is the world's) and turns it. It never passes the zenith
/// or the nadir. Diagonal moves are as fast as straight ones.
void fly(Camera& camera, const FlyInput& input, float metresPerSecond, double seconds);

/// Return a speed for a scene of that extent in meters, and the speed after notches of the wheel.
float defaultSpeed(float extent);
float changedSpeed(float metresPerSecond, float notches, float extent);

/// Returns a camera on a closed way through the keys, at least two, three seconds from one to the
/// next; smooth in place and direction.
Camera onPath(std::span<const Camera> keys, double seconds);
inline constexpr double kSecondsPerKey = 3.0;

/// Returns four keys around a camera that looks at what is that far away: a sway.
std::vector<Camera> swayAround(const Camera& home, float distance);

} // namespace afterglow
