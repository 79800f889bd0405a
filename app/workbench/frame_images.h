#pragma once

#include "renderer/image/image.h"
#include "renderer/pipeline/aov.h"
#include "shared/debug_view_params.h"

#include <string>
#include <string_view>
#include <vector>

namespace afterglow {

/// How one image of the frame is shown.
struct ImageDisplay {
    std::string_view name;  ///< of the AOV
    int map;                ///< gpu::kMap...
    float low, high;        ///< see gpu::DebugViewParams
    std::string_view unit;  ///< of the legend; may be empty
    bool perExtent = false; ///< low and high are in extents of the scene
    bool operator==(const ImageDisplay&) const = default;
};

/// One for every AOV, in the order of aovs(), with ranges that suit a scene of that extent in
/// metres.
std::vector<ImageDisplay> imageDisplays(float extent);

/// Of an image with a texel for every pixel, stratum or tile of a picture of that size.
gpu::DebugViewParams debugViewParams(const ImageDisplay& display, const AovSource& source,
                                     glm::ivec2 picture);

/// Low and high such that all but the outermost hundredth of the values are told apart; nothing is
/// changed if there are no finite values. `values` as readAov() gives them.
ImageDisplay fittedTo(const Image<glm::vec4>& values, ImageDisplay display);

/// Whether the map has two ends that can be set, one, or none.
int rangeEnds(int map);

} // namespace afterglow
