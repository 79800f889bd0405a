#pragma once

#include "renderer/image/image.h"

#include <string>
#include <string_view>

namespace afterglow {

// Bytes of picture files, made in memory. The same picture gives the same bytes; alpha is left out.

std::string jpeg(const Image<glm::u8vec4>& picture);     ///< quality 90
std::string grayJpeg(const Image<glm::u8vec4>& picture); ///< the red channel, quality 75
std::string grayPng(const Image<glm::u8vec4>& picture);  ///< the red channel, exact

std::string base64(std::string_view bytes); ///< with padding, without line breaks

} // namespace afterglow
