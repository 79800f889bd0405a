// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/scene/camera.h"

#include <span>
#include <vector>

namespace afterglow {

/// Returns a camera on a closed way through the keys, at least two, three seconds from one to the
/// next; smooth in place and direction.
Camera onPath(std::span<const Camera> keys, double seconds);
inline constexpr double kSecondsPerKey = 3.0;

/// Returns four keys around a camera that looks at what is that far away: a sway.
std::vector<Camera> swayAround(const Camera& home, float distance);

} // namespace afterglow
