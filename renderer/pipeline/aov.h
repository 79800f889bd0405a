#pragma once

#include "renderer/pipeline/renderer.h"

#include <span>
#include <string_view>

namespace afterglow {

/// An arbitrary output variable: one image of the frame that can be looked at and written to a
/// file.
struct AovInfo {
    std::string_view name;
    std::string_view meaning;  ///< with its unit
    std::string_view channels; ///< names of the channels in a file: "RGB", "Y", "XYZ", "XY"
    bool perStratum = false;   ///< ceil(W/3) x ceil(H/3) instead of W x H
};
std::span<const AovInfo> aovs();

/// UsageError names an unknown name and the nearest known.
const AovInfo& aovByName(std::string_view name);

/// Whether the filter makes it.
bool isMadeBy(const AovInfo& aov, Filter filter, const DenoiserSettings& settings);

/// Where the frame keeps an AOV: AovInfo::channels.size() channels of a texture, from one on.
struct AovSource {
    const GpuTexture& texture;
    int channel = 0;
    bool isFloatBits = false; ///< integers that hold the bits of floats
};
/// In the last frame that was rendered, of the filter with this state.
AovSource sourceOf(const Renderer& renderer, const AovInfo& aov, std::size_t state = 0);

/// Reads it back from the last frame; unused channels are 0.
Image<glm::vec4> readAov(const Renderer& renderer, const AovInfo& aov, std::size_t state = 0);

} // namespace afterglow
