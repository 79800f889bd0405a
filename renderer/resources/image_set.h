// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/resources/history.h"

#include <span>
#include <string_view>
#include <vector>

namespace afterglow {

/// The part of the picture that one texel of an image covers.
enum class ImageGrid { Pixels, Strata, Tiles, One };

/// Returns the number of strata that cover an image: ceil(size / 3).
glm::ivec2 strataOf(glm::ivec2 size);
/// Returns the number of tiles that cover an image: ceil(size / 8).
glm::ivec2 tilesOf(glm::ivec2 size);
/// Returns the number of cells of a grid that cover an image.
glm::ivec2 cellsOf(ImageGrid grid, glm::ivec2 size);

/// An image that somebody needs from frame to frame, or within a frame.
struct ImageDecl {
    std::string_view label; ///< lives as long as the program
    PixelFormat format;
    ImageGrid grid = ImageGrid::Pixels;
    bool isHistory = false; ///< the next frame reads it
};

/// The images that one list declares, by their place in it. Histories are there from the start;
/// others are made, all zero, when they are first asked for.
class ImageSet {
public:
    ImageSet() = default;
    /// Makes the histories, all zero. `declared` outlives the set.
    ImageSet(std::span<const ImageDecl> declared, glm::ivec2 size);

    std::span<const ImageDecl> declared() const { return declared_; }
    bool empty() const { return declared_.empty(); }

    /// Returns the image of this frame.
    GpuTexture& operator[](std::size_t image);
    const GpuTexture* find(std::size_t image) const; ///< empty: nobody has asked for it
    /// Returns the image of the frame before. Throws std::logic_error for an image that is no
    /// history.
    const GpuTexture& previous(std::size_t image) const;

    void swapHistories(); ///< current becomes previous
    void clearHistories();
    /// Returns the images that the next frame reads, in the order of the declarations.
    std::vector<GpuTexture*> kept();
    std::vector<const GpuTexture*> all() const; ///< that there are

private:
    std::span<const ImageDecl> declared_;
    glm::ivec2 size_{0};
    std::vector<GpuTexture> current_, previous_; ///< by place; empty ones where there are none yet
};

/// Returns the bytes of all images that are declared, for a picture of this size.
std::size_t bytesOf(std::span<const ImageDecl> declared, glm::ivec2 size);

} // namespace afterglow
