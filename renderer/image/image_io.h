// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/image/image.h"

#include <filesystem>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace afterglow {

// Every writer makes the same bytes from the same picture, and a whole file or none (base/file.h):
// Error, naming the file and the reason. Every reader throws InputError, naming the file and its
// fault. An empty picture cannot be written: std::logic_error.

/// Writes eight bits a channel, red, green, blue and alpha, as they are: the caller has encoded
/// them.
void writePng(const std::filesystem::path& path, const Image<glm::u8vec4>& image);

/// Reads any PNG, as eight bits of red, green, blue and alpha.
Image<glm::u8vec4> readPng(const std::filesystem::path& path);

/// Writes the first components of each pixel as 32-bit floats, one channel a name: names[0] is x.
/// One to four names, all different. Other programs understand R, G, B, A, and Y for gray.
void writeExr(const std::filesystem::path& path, const Image<glm::vec4>& image,
              const std::vector<std::string>& names);

/// Does the same with the usual names for 1 (Y), 2 (X, Y), 3 (R, G, B) or 4 (R, G, B, A) channels.
void writeExr(const std::filesystem::path& path, const Image<glm::vec4>& image, int channels);

/// Reads the channels of these names, in this order; with no names, R, G, B, A as far as they are
/// there, else all channels in the order of the file, which is that of the alphabet. A channel that
/// the file does not have is 0, alpha 1.
Image<glm::vec4> readExr(const std::filesystem::path& path,
                         const std::vector<std::string>& names = {});

/// Writes a portable float map, 32 bits, little endian: 1 channel (x) or 3 (xyz).
void writePfm(const std::filesystem::path& path, const Image<glm::vec4>& image, int channels);

/// Reads a portable float map; w is 1. A gray picture is in x, y and z alike.
Image<glm::vec4> readPfm(const std::filesystem::path& path);

} // namespace afterglow
