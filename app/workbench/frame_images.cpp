#include "app/workbench/frame_images.h"

#include "shared/bindings.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace afterglow {
namespace {

using namespace gpu;

constexpr std::string_view kRadiance = "radiance";

// Ranges suit lights that light a white floor to a radiance of about 1.
constexpr ImageDisplay kDisplays[] = {
    {"color", kMapRadiance, 0.0f, 1.0f, kRadiance},
    {"filtered", kMapRadiance, 0.0f, 1.0f, kRadiance},
    {"raw", kMapRadiance, 0.0f, 1.0f, kRadiance},
    {"accumulated", kMapRadiance, 0.0f, 1.0f, kRadiance},
    {"history_luminance", kMapScalar, 0.0f, 1.0f, kRadiance},
    {"variance", kMapLogarithm, 1e-5f, 1.0f, "radiance squared"},
    {"albedo", kMapRadiance, 0.0f, 1.0f, ""},
    {"emission", kMapRadiance, 0.0f, 10.0f, kRadiance},
    {"normal", kMapVector, -1.0f, 1.0f, ""},
    {"depth", kMapScalar, 0.0f, 0.6f, "m", true},
    {"position", kMapRepeat, 0.0f, 0.04f, "m", true},
    {"slope", kMapDirection, 0.0f, 0.002f, "m per pixel", true},
    {"motion", kMapDirection, 0.0f, 8.0f, "pixels"},
    {"instance", kMapNumber, 0.0f, 1.0f, ""},
    {"moments", kMapLogarithm, 1e-3f, 10.0f, kRadiance},
    {"history", kMapLogarithm, 1.0f, 128.0f, "frames"},
    {"alpha", kMapScalar, 0.0f, 1.0f, ""},
    {"reason", kMapNumber, 0.0f, 5.0f, ""},
    {"lambda", kMapScalar, 0.0f, 1.0f, ""},
    {"lambda_strata", kMapScalar, 0.0f, 1.0f, ""},
    {"gradient", kMapSigned, -0.5f, 0.5f, kRadiance},
    {"gradient_max", kMapScalar, 0.0f, 1.0f, kRadiance},
    {"gradient_sample", kMapSigned, -0.5f, 0.5f, kRadiance},
    {"gradient_sample_max", kMapScalar, 0.0f, 1.0f, kRadiance},
    {"samples", kMapNumber, 0.0f, 9.0f, ""},
    {"fate", kMapNumber, 0.0f, 7.0f, ""},
};

} // namespace

std::vector<ImageDisplay> imageDisplays(float extent) {
    std::vector<ImageDisplay> displays;
    for (const AovInfo& aov : aovs()) {
        const auto known = std::ranges::find(kDisplays, aov.name, &ImageDisplay::name);
        if (known == std::end(kDisplays))
            throw std::logic_error("no way to show the image " + std::string(aov.name));
        ImageDisplay display = *known;
        if (display.perExtent) {
            display.low *= extent;
            display.high *= extent;
            display.perExtent = false;
        }
        displays.push_back(display);
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
