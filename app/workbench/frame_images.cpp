// SPDX-License-Identifier: MIT
#include "app/workbench/frame_images.h"

#include "app/measure/truth_images.h"
#include "shared/bindings.h"

#include <algorithm>
#include <cmath>

namespace afterglow {

using namespace gpu;

std::span<const AovInfo> images() {
    static const std::vector<AovInfo> all = [] {
        std::vector<AovInfo> list(aovs().begin(), aovs().end());
        for (const TruthImage& image : truthImages())
            list.push_back(image.info);
        return list;
    }();
    return all;
}

std::vector<ImageDisplay> imageDisplays(float extent) {
    std::vector<ImageDisplay> displays;
    for (const AovInfo& image : images()) {
        ImageDisplay& display = displays.emplace_back(image.display);
        if (!std::exchange(display.perExtent, false))
            continue;
        display.low *= extent;
        display.high *= extent;
    }
    return displays;
}

gpu::DebugViewParams debugViewParams(const ImageDisplay& display, const AovSource& source,
                                     glm::ivec2 picture) {
    const glm::ivec2 texels = source.texture.size();
    const int pixelsPerTexel = texels == picture             ? 1
                               : texels == strataOf(picture) ? int(kStratumSize)
                                                             : int(kTileSize);
    return {.map = display.map,
            .channel = source.channel,
            .pixelsPerTexel = pixelsPerTexel,
            .isFloatBits = source.isFloatBits ? 1 : 0,
            .low = display.low,
            .high = display.high,
            .unused0 = 0.0f,
            .unused1 = 0.0f};
}

ImageDisplay fittedTo(const Image<glm::vec4>& values, ImageDisplay display) {
    if (rangeEnds(display.map) == 0 || display.map == kMapRepeat)
        return display;
    std::vector<float> sorted;
    for (const glm::vec4& value : values.pixels()) {
        float x = value.x;
        if (display.map == kMapRadiance)
            x = std::max({value.r, value.g, value.b});
        else if (display.map == kMapDirection)
            x = glm::length(glm::vec2(value));
        else if (display.map == kMapSigned)
            x = std::abs(x);
        const bool fits = std::isfinite(x) && (display.map != kMapLogarithm || x > 0.0f);
        if (fits)
            sorted.push_back(x);
    }
    if (sorted.empty())
        return display;
    std::ranges::sort(sorted);
    const float low = sorted[(sorted.size() - 1) / 100];
    const float high = sorted[(sorted.size() - 1) - (sorted.size() - 1) / 100];
    if (rangeEnds(display.map) == 2)
        display.low = low;
    display.high = std::max({high, display.low + 1e-6f, 1e-6f});
    if (display.map == kMapSigned)
        display.low = -display.high;
    return display;
}

int rangeEnds(int map) {
    switch (map) {
    case kMapScalar:
    case kMapLogarithm: return 2;
    case kMapRadiance:
    case kMapSigned:
    case kMapRepeat:
    case kMapDirection: return 1;
    default: return 0;
    }
}

} // namespace afterglow
