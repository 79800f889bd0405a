// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/pipeline/renderer.h"

#include <span>
#include <string>
#include <string_view>

namespace afterglow {

/// The images of a frame that can be looked at: those of the frame itself, then those of filters.
std::span<const AovInfo> aovs();

/// UsageError names an unknown name and the nearest known.
const AovInfo& aovByName(std::string_view name);

/// Returns whether a frame with this filter has the AOV.
bool isMadeBy(const AovInfo& aov, const FilterSettings& settings);

/// Where the frame keeps an AOV: AovInfo::channels.size() channels of a texture, from one on.
struct AovSource {
    const GpuTexture& texture;
    int channel = 0;
    bool isFloatBits = false; ///< integers that hold the bits of floats
};
/// In the last frame that was rendered, of the filter with this state. One that the frame does not
/// have is std::logic_error.
AovSource sourceOf(const Renderer& renderer, const AovInfo& aov, std::size_t state = 0,
                   std::size_t signal = 0);

/// Reads it back from the last frame; unused channels are 0.
Image<glm::vec4> readAov(const Renderer& renderer, const AovInfo& aov, std::size_t state = 0,
                         std::size_t signal = 0);

/// Returns the name of a file with this AOV: "raw", or "raw_ao" where a frame has several signals.
std::string fileStem(const AovInfo& aov, const SignalInfo& signal, std::size_t signals);

} // namespace afterglow
