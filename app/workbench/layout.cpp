// SPDX-License-Identifier: MIT
#include "app/workbench/layout.h"

#include <algorithm>
#include <cstdint>

namespace afterglow {

namespace {

constexpr NamedResolution kResolutions[] = {
    {"1/4 of the window", {.followWindow = true, .scale = 0.25f}},
    {"1/2 of the window", {.followWindow = true, .scale = 0.5f}},
    {"3/4 of the window", {.followWindow = true, .scale = 0.75f}},
    {"as the window", {.followWindow = true, .scale = 1.0f}},
    {"320 \xc3\x97 180", {.followWindow = false, .fixed = {320, 180}}},
    {"480 \xc3\x97 270", {.followWindow = false, .fixed = {480, 270}}},
    {"640 \xc3\x97 360", {.followWindow = false, .fixed = {640, 360}}},
    {"960 \xc3\x97 540", {.followWindow = false, .fixed = {960, 540}}},
    {"1280 \xc3\x97 720", {.followWindow = false, .fixed = {1280, 720}}},
    {"1920 \xc3\x97 1080", {.followWindow = false, .fixed = {1920, 1080}}},
};

} // namespace

Rect fitAspect(Rect area, glm::ivec2 image) {
    if (area.empty() || image.x <= 0 || image.y <= 0)
        return {area.min, glm::ivec2(0)};
    const std::int64_t w = area.size.x, h = area.size.y, x = image.x, y = image.y;
    const bool wide = x * h > w * y; // wider than the area: the width decides
    const glm::ivec2 size =
        wide ? glm::ivec2(w, (w * y + x / 2) / x) : glm::ivec2((h * x + y / 2) / y, h);
    const glm::ivec2 fitted = glm::clamp(size, glm::ivec2(1), area.size);
    return {area.min + (area.size - fitted) / 2, fitted};
}

Layout layoutOf(glm::ivec2 framebuffer, const LayoutWishes& wishes) {
    const glm::ivec2 size = glm::max(framebuffer, glm::ivec2(0));
    // A picture half as wide as the panel, and as high as a third of the curves and the strip.
    const int leastWidth = std::max(wishes.panel / 2, 1), leastHeight = 96;
    const int panel = size.x >= wishes.panel + leastWidth ? wishes.panel : 0;
    const int side = size.x >= wishes.panel + wishes.side + 2 * leastWidth ? wishes.side : 0;
    const int strip = size.y >= wishes.strip + leastHeight ? wishes.strip : 0;
    const int curves = size.y >= wishes.strip + wishes.curves + 2 * leastHeight ? wishes.curves : 0;

    const int width = size.x - panel - side;
    const int below = size.y - strip - curves;
    const auto shown = [](glm::ivec2 min, glm::ivec2 extent) {
        return Rect{min, extent.x > 0 && extent.y > 0 ? extent : glm::ivec2(0)};
    };
    return {.panel = shown({0, 0}, {panel, size.y}),
            .side = shown({size.x - side, 0}, {side, size.y}),
            .curves = shown({panel, below}, {width, curves}),
            .strip = shown({panel, below + curves}, {width, strip}),
            .view = {{panel, 0}, {width, below}}};
}

bool Resolution::operator==(const Resolution& other) const {
    return followWindow == other.followWindow &&
           (followWindow ? scale == other.scale : fixed == other.fixed);
}

std::span<const NamedResolution> resolutions() {
    return kResolutions;
}

Resolution nextResolution(const Resolution& resolution, int step) {
    const auto pixels = [](const Resolution& r) {
        return r.followWindow ? double(r.scale) : double(r.fixed.x) * double(r.fixed.y);
    };
    Resolution next = resolution;
    for (const auto& [name, choice] : kResolutions) {
        if (choice.followWindow != resolution.followWindow)
            continue;
        const double way = double(step) * (pixels(choice) - pixels(resolution));
        const double best = double(step) * (pixels(next) - pixels(resolution));
        if (way > 0.0 && (best <= 0.0 || way < best))
            next = choice;
    }
    return next;
}

Resolution startResolution(bool softwareRasterizer, glm::ivec2 view) {
    Resolution resolution;
    resolution.followWindow =
        !softwareRasterizer || view.x * view.y <= resolution.fixed.x * resolution.fixed.y;
    return resolution;
}

glm::ivec2 renderSize(const Resolution& resolution, glm::ivec2 view) {
    if (view.x <= 0 || view.y <= 0)
        return glm::ivec2(0);
    if (!resolution.followWindow)
        return resolution.fixed;
    return glm::max(glm::ivec2(glm::round(glm::vec2(view) * resolution.scale)), glm::ivec2(1));
}

} // namespace afterglow
