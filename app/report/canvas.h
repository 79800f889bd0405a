// SPDX-License-Identifier: MIT
#pragma once

#include "app/report/typeface.h"
#include "renderer/image/image.h"

#include <span>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace afterglow {

/// A line through points, drawn with a round pen.
using Polyline = std::vector<glm::vec2>;

/// Colors of a contact sheet.
namespace sheet {
inline constexpr glm::u8vec3 kGround{15, 17, 21}; ///< behind everything
inline constexpr glm::u8vec3 kBright{236, 239, 244}, kText{190, 196, 206}, kFaint{128, 136, 150};
} // namespace sheet

/// How text is written.
struct TextStyle {
    float size = 16.0f; ///< pixels an em
    Weight weight = Weight::Regular;
    glm::u8vec3 color{220};
    /// Horizontal alignment: 0 puts the text's left end at the given place, 1 its right end.
    float align = 0.0f;

    TextStyle aligned(float where) const { return {size, weight, color, where}; }
    TextStyle colored(glm::u8vec3 other) const { return {size, weight, other, align}; }
    float width(std::string_view text) const { return textWidth(text, size, weight); }
};

/// A picture to draw on: sRGB colors, smooth edges. Positions are in pixels, (0, 0) is the upper
/// left corner of the upper left pixel. What lies outside is left out.
class Canvas {
public:
    Canvas(glm::ivec2 size, glm::u8vec3 background);

    const Image<glm::u8vec4>& image() const { return image_; }

    void fill(glm::ivec2 corner, glm::ivec2 size, glm::u8vec3 color);
    void place(glm::ivec2 corner, const Image<glm::u8vec4>& picture); ///< its alpha is ignored

    /// Lines with a round pen. Lines that overlap do not add up.
    void stroke(std::span<const Polyline> lines, float pen, glm::u8vec3 color,
                float opacity = 1.0f);
    void line(glm::vec2 from, glm::vec2 to, float pen, glm::u8vec3 color, float opacity = 1.0f);
    void dashed(glm::vec2 from, glm::vec2 to, float dash, float gap, float pen, glm::u8vec3 color,
                float opacity = 1.0f);
    void dot(glm::vec2 center, float radius, glm::u8vec3 color);

    /// `at` is on the baseline.
    void text(glm::vec2 at, std::string_view text, const TextStyle& style);

private:
    void blend(glm::ivec2 p, glm::u8vec3 color, float opacity);

    Image<glm::u8vec4> image_;
};

} // namespace afterglow
