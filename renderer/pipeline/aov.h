#pragma once

#include "renderer/pipeline/renderer.h"

#include <span>
#include <string_view>

namespace afterglow {

/// An arbitrary output variable: one image of the frame that can be looked at and written to a
/// file.
struct AovInfo {
    std::string_view name;
    std::string_view meaning;   ///< with its unit
    std::string_view channels;  ///< names of the channels in a file: "RGB", "Y", "XYZ", "XY"
    bool perStratum = false;    ///< ceil(W/3) x ceil(H/3) instead of W x H
    bool needsGradient = false; ///< made only by filters that carry gradient samples
    bool needsHistory = false;  ///< made only by filters that accumulate
};
std::span<const AovInfo> aovs();

/// UsageError names an unknown name and the nearest known.
const AovInfo& aovByName(std::string_view name);

/// Whether the filter makes it.
bool isMadeBy(const AovInfo& aov, Filter filter, const DenoiserSettings& settings);

/// Reads it back from the last frame; unused channels are 0.
Image<glm::vec4> readAov(const Renderer& renderer, const AovInfo& aov);

} // namespace afterglow
