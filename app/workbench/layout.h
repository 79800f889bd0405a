// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include <glm/glm.hpp>

namespace afterglow {

/// Pixels [min, min + size) of a framebuffer; y points down.
struct Rect {
    glm::ivec2 min{0}, size{0};

    bool empty() const { return size.x <= 0 || size.y <= 0; }
    bool operator==(const Rect&) const = default;
};

/// The largest rectangle in the middle of `area` with the proportions of `image`, at least one
/// pixel along each edge. Empty if either is.
Rect fitAspect(Rect area, glm::ivec2 image);

/// How much room things want, in pixels; 0: they are not shown.
struct LayoutWishes {
    int panel = 0;  ///< width, on the left
    int side = 0;   ///< width, on the right: inspector, passes
    int curves = 0; ///< height, below the picture
    int strip = 0;  ///< height, below all
};
/// Where things are in a window; what is not shown is empty. What would leave too little room for
/// the picture is not shown: first the side, then the curves, the strip and the panel.
struct Layout {
    Rect panel, side, curves, strip;
    Rect view; ///< what is left for the pictures
};
Layout layoutOf(glm::ivec2 framebuffer, const LayoutWishes& wishes);

/// How many pixels are rendered.
struct Resolution {
    bool followWindow = true; ///< `scale` times the view, else `fixed`
    float scale = 1.0f;
    glm::ivec2 fixed{640, 360};

    /// The same number of pixels: the member that does not count may differ.
    bool operator==(const Resolution& other) const;
};

/// What can be chosen, from few pixels to many: first in parts of the view, then fixed sizes.
struct NamedResolution {
    std::string_view name;
    Resolution resolution;
};
std::span<const NamedResolution> resolutions();
/// Of the same kind with the next larger number of pixels (step 1), or the next smaller (step -1).
Resolution nextResolution(const Resolution& resolution, int step);

/// As many pixels as the view has, on a software rasterizer at most as many as stay quick: 640 x
/// 360.
Resolution startResolution(bool softwareRasterizer, glm::ivec2 view);

/// Zero along an edge: there is nothing to render, the window is minimized.
glm::ivec2 renderSize(const Resolution& resolution, glm::ivec2 view);

} // namespace afterglow
