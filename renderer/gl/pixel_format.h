// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <glad/gl.h>
#include <glm/glm.hpp>
#include <glm/gtc/type_precision.hpp>

namespace afterglow {

enum class PixelFormat {
    R32F,
    RG32F,
    RGBA32F,
    RGBA16F,
    R32UI,
    RG32UI,
    RGBA32UI,
    RGBA8,
    SRGBA8, ///< three numbers as sRGB encodes them, which samplers decode, and a linear fourth
    Depth32F
};

struct FormatInfo {
    GLenum internal, layout, type; ///< as OpenGL spells it; layout and type: how pixels are given
    int bytes;                     ///< of one pixel on the device
    std::string_view name;         ///< as in PixelFormat
    bool isInteger;
    bool isImage; ///< shaders can load from it and store to it
};
FormatInfo info(PixelFormat format);

/// The names that OpenGL has for a pixel type of C++.
struct PixelInfo {
    GLenum layout, type;
    std::string_view name;
};
template <class Pixel>
constexpr PixelInfo kPixelInfo{};
template <>
inline constexpr PixelInfo kPixelInfo<float>{GL_RED, GL_FLOAT, "float"};
template <>
inline constexpr PixelInfo kPixelInfo<glm::vec2>{GL_RG, GL_FLOAT, "vec2"};
template <>
inline constexpr PixelInfo kPixelInfo<glm::vec4>{GL_RGBA, GL_FLOAT, "vec4"};
template <>
inline constexpr PixelInfo kPixelInfo<std::uint32_t>{GL_RED_INTEGER, GL_UNSIGNED_INT, "uint"};
template <>
inline constexpr PixelInfo kPixelInfo<glm::uvec2>{GL_RG_INTEGER, GL_UNSIGNED_INT, "uvec2"};
template <>
inline constexpr PixelInfo kPixelInfo<glm::uvec4>{GL_RGBA_INTEGER, GL_UNSIGNED_INT, "uvec4"};
template <>
inline constexpr PixelInfo kPixelInfo<glm::u8vec4>{GL_RGBA, GL_UNSIGNED_BYTE, "u8vec4"};

/// Calls a macro with each pixel type that textures take and give.
#define AFTERGLOW_FOR_EACH_PIXEL(use)                                                              \
    use(float) use(glm::vec2) use(glm::vec4) use(std::uint32_t) use(glm::uvec2) use(glm::uvec4)    \
        use(glm::u8vec4)

/// Throws std::logic_error unless a texture of this format takes and gives such pixels.
void checkPixel(std::string_view label, PixelFormat format, const PixelInfo& pixel);

/// Returns "61 x 37".
std::string sizeText(glm::ivec2 size);

} // namespace afterglow
