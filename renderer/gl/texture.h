// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/object.h"
#include "renderer/gl/pixel_format.h"
#include "renderer/image/image.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace afterglow {

/// A 2D texture with immutable storage and one mip level, fetched without filtering.
/// What it holds at first is undefined.
class GpuTexture {
public:
    GpuTexture() = default;
    GpuTexture(std::string_view label, PixelFormat format, glm::ivec2 size);

    GLuint id() const { return object_.id(); }
    PixelFormat format() const { return format_; }
    glm::ivec2 size() const { return size_; }
    const std::string& label() const { return label_; }
    std::size_t bytes() const; ///< on the device

    /// Replaces, or returns, all pixels, row 0 first. Pixel is one of float, glm::vec2, glm::vec4,
    /// std::uint32_t, glm::uvec2, glm::uvec4, glm::u8vec4, with the components of the format;
    /// RGBA16F takes and gives vec4, Depth32F float. Anything else, or another size, is
    /// std::logic_error.
    template <class Pixel>
    void write(const Image<Pixel>& image);
    template <class Pixel>
    Image<Pixel> read() const;

    /// Returns one pixel, inside the texture; as read().
    template <class Pixel>
    Pixel readAt(glm::ivec2 p) const;

    void clear(); ///< to zero
    /// Takes all pixels of a texture of the same format and size; others are std::logic_error.
    void copyFrom(const GpuTexture& other);
    /// Returns a texture of its own with the same label, format, size and pixels.
    GpuTexture copy() const;

private:
    GlObject<TextureKind> object_;
    std::string label_;
    PixelFormat format_{};
    glm::ivec2 size_{0};
};

} // namespace afterglow
