// SPDX-License-Identifier: MIT
#include "renderer/gl/pixel_format.h"

#include <stdexcept>

namespace afterglow {

FormatInfo info(PixelFormat format) {
    switch (format) {
    case PixelFormat::R32F: return {GL_R32F, GL_RED, GL_FLOAT, 4, "R32F", false, true};
    case PixelFormat::RG32F: return {GL_RG32F, GL_RG, GL_FLOAT, 8, "RG32F", false, true};
    case PixelFormat::RGBA32F: return {GL_RGBA32F, GL_RGBA, GL_FLOAT, 16, "RGBA32F", false, true};
    case PixelFormat::RGBA16F: return {GL_RGBA16F, GL_RGBA, GL_FLOAT, 8, "RGBA16F", false, true};
    case PixelFormat::R32UI:
        return {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 4, "R32UI", true, true};
    case PixelFormat::RG32UI:
        return {GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT, 8, "RG32UI", true, true};
    case PixelFormat::RGBA32UI:
        return {GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT, 16, "RGBA32UI", true, true};
    case PixelFormat::RGBA8: return {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4, "RGBA8", false, true};
    case PixelFormat::SRGBA8:
        return {GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, 4, "SRGBA8", false, false};
    case PixelFormat::Depth32F:
        return {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 4, "Depth32F", false, false};
    }
    throw std::logic_error("a pixel format that is not in the table");
}

void checkPixel(std::string_view label, PixelFormat format, const PixelInfo& pixel) {
    const FormatInfo wanted = info(format);
    const bool oneFloat = format == PixelFormat::Depth32F && pixel.layout == GL_RED;
    if (pixel.type != wanted.type || (pixel.layout != wanted.layout && !oneFloat))
        throw std::logic_error("texture " + std::string(label) + " is " + std::string(wanted.name) +
                               ", which does not hold pixels of type " + std::string(pixel.name));
}

std::string sizeText(glm::ivec2 size) {
    return std::to_string(size.x) + " x " + std::to_string(size.y);
}

} // namespace afterglow
