// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/image/image.h"

#include <cstdint>
#include <string>

namespace afterglow {

/// Returns a square tile of blue noise: the ranks 0 .. edge * edge - 1, each once. However many of
/// the lowest ranks one takes, they lie evenly and without a pattern, and the tile repeats without
/// a seam. The void-and-cluster method of Ulichney, "The void-and-cluster method for dither array
/// generation", 1993. The same edge and seed give the same tile everywhere: energies are integers.
/// `edge` is in [2, 256], so that every rank fits; anything else is a std::logic_error.
Image<std::uint16_t> makeBlueNoise(int edge, std::uint32_t seed);

/// Spreads ranks over 16 bits: value / 65536 is uniform in [0, 1). The number of pixels must divide
/// 65536, that is, the edge is a power of two.
Image<std::uint16_t> spreadRanks(const Image<std::uint16_t>& ranks);

/// Returns a binary PGM ("P5") of two bytes a pixel, most significant byte first, as the format
/// demands.
std::string writePgm16(const Image<std::uint16_t>& image);

} // namespace afterglow
