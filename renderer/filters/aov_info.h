// SPDX-License-Identifier: MIT
#pragma once

#include "shared/debug_view_params.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace afterglow {

/// A color map for the numbers of an image: the map, its range and its unit.
struct ImageDisplay {
    int map = gpu::kMapScalar;     ///< gpu::kMap...
    float low = 0.0f, high = 1.0f; ///< see gpu::DebugViewParams
    std::string_view unit{};       ///< of the legend; may be empty
    bool perExtent = false;        ///< low and high are in extents of the scene

    bool operator==(const ImageDisplay&) const = default;
};

// Ranges suit lights that light a white floor to a radiance of about 1.
constexpr ImageDisplay radiance(float white = 1.0f) {
    return {gpu::kMapRadiance, 0.0f, white, "radiance"};
}
constexpr ImageDisplay linear(float low, float high, std::string_view unit = {}) {
    return {gpu::kMapScalar, low, high, unit};
}
constexpr ImageDisplay logarithmic(float low, float high, std::string_view unit) {
    return {gpu::kMapLogarithm, low, high, unit};
}
constexpr ImageDisplay aroundZero(float high, std::string_view unit = {}) {
    return {gpu::kMapSigned, -high, high, unit};
}
constexpr ImageDisplay numbersUpTo(float most) {
    return {gpu::kMapNumber, 0.0f, most};
}

/// The part of a frame that makes an image.
enum class ImageGroup : std::uint8_t { Light, Surfaces, Samples, Filter, History, Change, Truth };
constexpr std::string_view titleOf(ImageGroup group) {
    constexpr std::string_view kTitles[] = {"Light",       "Surfaces", "Gradient samples",
                                            "Filter",      "History",  "Change of light",
                                            "Ground truth"};
    return kTitles[std::size_t(group)];
}

/// An arbitrary output variable: one image of the frame that can be looked at and, but for the
/// ground truth, written to a file. Options, lists, menus and legends are made from it.
struct AovInfo {
    std::string_view name;
    std::string_view meaning;  ///< with its unit
    std::string_view channels; ///< names of the channels in a file: "RGB", "Y", "XYZ", "XY"
    ImageGroup group;
    ImageDisplay display;    ///< at first
    bool perSignal = false;  ///< each signal of a frame has its own
    bool perStratum = false; ///< ceil(W/3) x ceil(H/3) instead of W x H
};
inline constexpr bool kPerSignal = true, kPerStratum = true;

} // namespace afterglow
