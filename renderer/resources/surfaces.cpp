// SPDX-License-Identifier: MIT
#include "renderer/resources/surfaces.h"

#include <array>
#include <string>

namespace afterglow {
namespace {

struct Row {
    GpuTexture Surfaces::*image;
    std::string_view label;
    PixelFormat format;
};
constexpr std::array kRows{Row{&Surfaces::visibility, "visibility", PixelFormat::RGBA32UI},
                           Row{&Surfaces::surface, "surface", PixelFormat::RGBA32UI},
                           Row{&Surfaces::guides, "guides", PixelFormat::RGBA32F},
                           Row{&Surfaces::slope, "slope", PixelFormat::RG32F},
                           Row{&Surfaces::motion, "motion", PixelFormat::RGBA32F},
                           Row{&Surfaces::albedo, "albedo", PixelFormat::RGBA32F},
                           Row{&Surfaces::emission, "emission", PixelFormat::RGBA32F}};

} // namespace

Surfaces::Surfaces(glm::ivec2 size, std::string_view prefix) {
    for (const Row& row : kRows) {
        this->*row.image =
            GpuTexture(std::string(prefix) + std::string(row.label), row.format, size);
        (this->*row.image).clear();
    }
}

std::vector<const GpuTexture*> Surfaces::all() const {
    std::vector<const GpuTexture*> images;
    for (const Row& row : kRows)
        images.push_back(&(this->*row.image));
    return images;
}

} // namespace afterglow
