// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/image/image.h"

#include <cstdint>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace afterglow {

// Roboto, which is linked into the program. Texts are UTF-8; a character that the typeface lacks,
// or a byte that is none, shows as a box. `size`: pixels an em; capitals are 0.71 of it high.

enum class Weight { Regular, Medium };

/// The coverage of the pixels by a letter, 255 is all, whose upper left pixel is at `corner`.
struct Glyph {
    glm::ivec2 corner{0};
    Image<std::uint8_t> coverage;
};

/// The letters of a line of text that begins at (x, 0) on its baseline, y down.
std::vector<Glyph> glyphsOf(std::string_view text, float size, Weight weight, float x);

/// Returns how far a line of text reaches, in pixels.
float textWidth(std::string_view text, float size, Weight weight);

} // namespace afterglow
