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

/// Where things are in a window. The panel leaves when the window is too narrow for it and a
/// picture.
struct Layout {
    Rect panel; ///< empty: not shown
    Rect view;  ///< what is left for the picture
};
Layout layoutOf(glm::ivec2 framebuffer, int panelWidth, bool showPanel);

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
