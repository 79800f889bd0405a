// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/pipeline/aov.h"

#include <vector>

namespace afterglow {

/// Returns all images that can be looked at: aovs(), then truthImages().
std::span<const AovInfo> images();
inline bool isTruth(std::size_t image) {
    return image >= aovs().size();
}

/// Returns how each of images() is shown at first in a scene of that extent in meters.
std::vector<ImageDisplay> imageDisplays(float extent);

/// Of an image with a texel for every pixel, stratum or tile of a picture of that size.
gpu::DebugViewParams debugViewParams(const ImageDisplay& display, const AovSource& source,
                                     glm::ivec2 picture);

/// Low and high such that all but the outermost hundredth of the values are told apart; nothing is
/// changed if there are no finite values. `values` as readAov() gives them.
ImageDisplay fittedTo(const Image<glm::vec4>& values, ImageDisplay display);

/// Returns the number of ends of a map that can be set: 2, 1 or 0.
int rangeEnds(int map);

} // namespace afterglow
