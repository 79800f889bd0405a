// SPDX-License-Identifier: MIT
#include "app/report/canvas.h"

#include <algorithm>
#include <cmath>

namespace afterglow {
namespace {

float distanceToSegment(glm::vec2 p, glm::vec2 a, glm::vec2 b) {
    const glm::vec2 along = b - a;
    const float squared = glm::dot(along, along);
    const float t =
        squared > 0.0f ? std::clamp(glm::dot(p - a, along) / squared, 0.0f, 1.0f) : 0.0f;
    return glm::length(p - (a + t * along));
}

struct PixelBox {
    glm::ivec2 min, max; ///< max is the first beyond
};

PixelBox boxAround(glm::vec2 low, glm::vec2 high, float margin, PixelBox limit) {
    return {glm::max(glm::ivec2(glm::floor(low - margin)), limit.min),
            glm::min(glm::ivec2(glm::ceil(high + margin)), limit.max)};
}

} // namespace

Canvas::Canvas(glm::ivec2 size, glm::u8vec3 background)
    : image_(size, glm::u8vec4(background, 255)) {}

void Canvas::blend(glm::ivec2 p, glm::u8vec3 color, float opacity) {
    glm::u8vec4& pixel = image_(p);
    const glm::vec3 mixed = glm::mix(glm::vec3(pixel), glm::vec3(color), opacity);
    pixel = glm::u8vec4(glm::u8vec3(mixed + 0.5f), 255);
}

void Canvas::fill(glm::ivec2 corner, glm::ivec2 size, glm::u8vec3 color) {
    for (int y = corner.y; y < corner.y + size.y; ++y) {
        for (int x = corner.x; x < corner.x + size.x; ++x) {
            if (image_.contains({x, y}))
                image_({x, y}) = glm::u8vec4(color, 255);
        }
    }
}

void Canvas::place(glm::ivec2 corner, const Image<glm::u8vec4>& picture) {
    for (int y = 0; y < picture.size().y; ++y) {
        for (int x = 0; x < picture.size().x; ++x) {
            const glm::ivec2 p = corner + glm::ivec2(x, y);
            if (image_.contains(p))
                image_(p) = glm::u8vec4(glm::u8vec3(picture({x, y})), 255);
        }
    }
}

void Canvas::stroke(std::span<const Polyline> lines, float pen, glm::u8vec3 color, float opacity) {
    glm::vec2 low(1e9f), high(-1e9f);
    for (const Polyline& points : lines) {
        for (const glm::vec2 p : points) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    }
    // A pen thinner than a pixel covers a part of it.
    const float radius = std::max(pen, 1.0f) / 2.0f;
    const float thinness = std::min(pen, 1.0f);
    const float margin = radius + 1.0f;
    const PixelBox all = boxAround(low, high, margin, {glm::ivec2(0), image_.size()});
    if (all.min.x >= all.max.x || all.min.y >= all.max.y)
        return;

    Image<float> coverage(all.max - all.min);
    for (const Polyline& points : lines) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            // A line of one point is a dot.
            const glm::vec2 a = points[i], b = points[std::min(i + 1, points.size() - 1)];
            const PixelBox box = boxAround(glm::min(a, b), glm::max(a, b), margin, all);
            for (int y = box.min.y; y < box.max.y; ++y) {
                for (int x = box.min.x; x < box.max.x; ++x) {
                    const float d = distanceToSegment(glm::vec2(x, y) + 0.5f, a, b);
                    float& covered = coverage(glm::ivec2(x, y) - all.min);
                    covered = std::max(covered, std::clamp(radius + 0.5f - d, 0.0f, 1.0f));
                }
            }
        }
    }
    for (int y = all.min.y; y < all.max.y; ++y) {
        for (int x = all.min.x; x < all.max.x; ++x) {
            if (const float c = coverage(glm::ivec2(x, y) - all.min); c > 0.0f)
                blend({x, y}, color, c * thinness * opacity);
        }
    }
}

void Canvas::line(glm::vec2 from, glm::vec2 to, float pen, glm::u8vec3 color, float opacity) {
    const Polyline points = {from, to};
    stroke({&points, 1}, pen, color, opacity);
}

void Canvas::dashed(glm::vec2 from, glm::vec2 to, float dash, float gap, float pen,
                    glm::u8vec3 color, float opacity) {
    const float length = glm::distance(from, to);
    const glm::vec2 along = length > 0.0f ? (to - from) / length : glm::vec2(0.0f);
    for (float at = 0.0f; at < length; at += dash + gap)
        line(from + at * along, from + std::min(at + dash, length) * along, pen, color, opacity);
}

void Canvas::dot(glm::vec2 center, float radius, glm::u8vec3 color) {
    line(center, center, 2.0f * radius, color);
}

void Canvas::text(glm::vec2 at, std::string_view text, const TextStyle& style) {
    const int baseline = int(std::floor(at.y)); // horizontal strokes are as sharp as can be
    const float left = at.x - style.align * style.width(text);
    for (const Glyph& glyph : glyphsOf(text, style.size, style.weight, left)) {
        const glm::ivec2 size = glyph.coverage.size();
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const glm::ivec2 p = glyph.corner + glm::ivec2(x, y + baseline);
                if (image_.contains(p))
                    blend(p, style.color, float(glyph.coverage({x, y})) / 255.0f);
            }
        }
    }
}

} // namespace afterglow
