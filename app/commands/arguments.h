#pragma once

#include "renderer/base/names.h"
#include "renderer/pipeline/light_state.h"
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

/// From which frame on a light is in which state.
struct LightChange {
    std::string light;
    int frame = 0;
    LightState state{};
    bool operator==(const LightChange&) const = default;
};

/// "key=off@8", "key=on@16", "fill=0.5" (power, from frame 0 on).
LightChange parseLightChange(std::string_view option, std::string_view text);

/// The slot of a light of the scene; UsageError names the nearest known.
std::size_t lightSlot(const Scene& scene, std::string_view name);

/// Index of a camera of the scene; the empty name is the first.
std::size_t cameraIndex(const Scene& scene, std::string_view name);

/// State of every light slot at a frame: the last change at or before it holds.
std::vector<LightState> lightsAt(const Scene& scene, const std::vector<LightChange>& changes,
                                 int frame);

} // namespace afterglow
