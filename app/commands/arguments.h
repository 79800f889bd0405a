// SPDX-License-Identifier: MIT
#pragma once

#include "app/scenario/timeline.h"
#include "renderer/base/names.h"
#include "renderer/scene/scene.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace afterglow {

// The words of the command line as values. Each throws UsageError that names the option, what was
// found and what may stand there.

constexpr int kMaxEdge = 16384;                       ///< pixels along one side of an image
constexpr std::int64_t kMaxPixels = 64 * 1024 * 1024; ///< of one image

/// "1280x720".
glm::ivec2 parseSize(std::string_view option, std::string_view text);

/// A whole number in [min, max].
std::int64_t parseWhole(std::string_view option, std::string_view text, std::int64_t min,
                        std::int64_t max);

/// A finite number in [min, max].
double parseNumber(std::string_view option, std::string_view text, double min, double max);

/// "color,lambda" as its parts; empty ones are refused.
std::vector<std::string> parseList(std::string_view option, std::string_view text);

/// "key" and "value" of "key=value".
std::pair<std::string, std::string> parseAssignment(std::string_view option, std::string_view text);

/// Parses "key=off@8", "key=on@16", "fill=0.5" (power, from frame 0 on). The event sets both `on`
/// and `power`: what the text leaves out is as the scene has it.
LightEvent parseLightEvent(std::string_view option, std::string_view text);

/// Index of a camera of the scene; the empty name is the first.
std::size_t cameraIndex(const Scene& scene, std::string_view name);

} // namespace afterglow
