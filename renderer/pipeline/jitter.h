// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/pipeline/settings.h"

#include <cstdint>

namespace afterglow {

/// Frames after which the places in a pixel come again.
inline constexpr std::uint32_t kJitterCycle = 16;

/// Returns the place in each pixel at which a frame looks, pixels from the center, y down: the
/// Halton sequence of bases 2 and 3 from its number 1 on, minus 1/2. Within (-1/2, 1/2).
glm::vec2 jitterAt(std::uint32_t frame);
/// The same where it is asked for, else 0.
glm::vec2 jitterOf(const DisplaySettings& display, std::uint32_t frame);

} // namespace afterglow
