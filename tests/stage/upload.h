// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/texture.h"

#include <cstdint>
#include <string_view>

namespace afterglow::test {

template <class Pixel>
constexpr PixelFormat kFormatOf{};
template <>
inline constexpr PixelFormat kFormatOf<float> = PixelFormat::R32F;
template <>
inline constexpr PixelFormat kFormatOf<std::uint32_t> = PixelFormat::R32UI;
template <>
inline constexpr PixelFormat kFormatOf<glm::vec2> = PixelFormat::RG32F;
template <>
inline constexpr PixelFormat kFormatOf<glm::vec4> = PixelFormat::RGBA32F;
template <>
inline constexpr PixelFormat kFormatOf<glm::uvec4> = PixelFormat::RGBA32UI;

/// A texture of the image's own format that holds it.
template <class Pixel>
GpuTexture upload(std::string_view label, const Image<Pixel>& image) {
    GpuTexture texture(label, kFormatOf<Pixel>, image.size());
    texture.write(image);
    return texture;
}

} // namespace afterglow::test
