// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/image/image.h"

#include <cstdint>
#include <string_view>

namespace afterglow {

/// Reads a binary PGM ("P5") of two bytes a pixel and returns its pixels as stored. `name` stands
/// in front of every InputError.
Image<std::uint16_t> readPgm16(std::string_view bytes, std::string_view name);

} // namespace afterglow
