#pragma once

#include "app/report/stroke_font.h"
#include "renderer/image/image.h"

#include <span>
#include <string_view>

#include <glm/glm.hpp>

namespace afterglow {

/// How text is written.
struct TextStyle {
    float size = 1.4f; ///< pixels per unit of the typeface: capitals are 7 times as high
    float pen = 1.4f;  ///< the strokes' width in pixels
    glm::u8vec3 color{220};
    float align =
        0.0f; ///< which part of the text is at the given place: 0 its left end, 1 its right
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
