// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/object.h"
#include "renderer/gl/pixel_format.h"
#include "renderer/image/image.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace afterglow {

enum class TextureFilter {
    Nearest,  ///< one texel of the nearest level
    Trilinear ///< between four texels in each of two levels; not for integers and depth
};
enum class TextureWrap { Clamp, Repeat, MirroredRepeat };

/// The filtering and wrapping of a texture that a shader samples.
struct TextureSampling {
    TextureFilter filter = TextureFilter::Nearest;
    TextureWrap wrapX = TextureWrap::Clamp, wrapY = TextureWrap::Clamp;
};

/// Returns the number of levels from this size down to a single pixel.
int mipLevels(glm::ivec2 size);

/// 2D textures of one size and format, its layers, with immutable storage: a sampler2DArray or an
/// image2DArray, with a u in front where the format is of integers. Images are of level 0 and have
/// all layers. What it holds at first is undefined.
class GpuTextureArray {
public:
    GpuTextureArray() = default;
    /// Throws Error where the driver has no textures of that many layers or pixels.
    GpuTextureArray(std::string_view label, PixelFormat format, glm::ivec2 size, int layers,
                    int levels = 1);

    GLuint id() const { return object_.id(); }
    PixelFormat format() const { return format_; }
    glm::ivec2 size() const { return size_; }
    glm::ivec2 sizeOf(int level) const; ///< half of the level before, rounded down, at least 1
    int layers() const { return layers_; }
    int levels() const { return levels_; }
    const std::string& label() const { return label_; }
    std::size_t bytes() const; ///< on the device, of all levels

    /// Replaces all pixels of one layer at level 0, row 0 first; as GpuTexture::write().
    template <class Pixel>
    void write(int layer, const Image<Pixel>& image);
    /// Returns all pixels of one layer; as GpuTexture::read().
    template <class Pixel>
    Image<Pixel> read(int layer, int level = 0) const;

    /// Makes every level after the first from the one before, in all layers. The driver averages
    /// its pixels: as light where the format is sRGB, and at odd sizes as it sees fit. Integers and
    /// depth are std::logic_error.
    void makeMips();
    void clear(); ///< to zero, in all levels

    /// Sets how shaders sample it. Nearest and clamped at first.
    void setSampling(const TextureSampling& sampling);

private:
    void checkPlace(int layer, int level) const;

    GlObject<TextureKind> object_;
    std::string label_;
    PixelFormat format_{};
    glm::ivec2 size_{0};
    int layers_ = 0, levels_ = 0;
};

} // namespace afterglow
