#include "app/report/stroke_font.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace afterglow {
namespace {

struct Glyph {
    float width; ///< without the space to the next character
    const char* path;
};

// Paths: M x y begins a stroke, L x y continues it straight, C with two control points as a Bezier
// curve. E cx cy rx ry from to begins a stroke with an elliptic arc between two angles in degrees
// (counterclockwise where `to` is greater); e continues the stroke to it.
// clang-format off: one glyph a line
constexpr std::array<Glyph, 95> kGlyphs = {{
    {1.2f, ""},                                                                      // space
    {0.0f, "M 0 7 L 0 2.3 M 0 0 L 0 .2"},                                            // !
    {1.5f, "M 0 7 L 0 5.2 M 1.5 7 L 1.5 5.2"},                                       // "
    {4.8f, "M 1.1 0 L 2 7 M 3 0 L 3.9 7 M .4 4.7 L 4.8 4.7 M 0 2.3 L 4.4 2.3"},      // #
    {4.2f, "E 2.1 5.2 1.9 1.7 40 270 e 2.1 1.75 2.1 1.75 90 -140 M 2.1 8 L 2.1 -1"}, // $
    {5.8f, "E 1.2 5.6 1.2 1.4 0 360 E 4.6 1.4 1.2 1.4 0 360 M 4.6 7 L 1.2 0"},       // %
    {5.0f, "M 5 0 L 1 5 C .4 5.9 .9 7 2 7 C 3.1 7 3.5 5.7 2.7 4.9 L 1 3.5 C -.5 2.1 .2 0 2 0 "
           "C 3.6 0 4.6 1.5 4.8 3"},                                              // &
    {0.0f, "M 0 7 L 0 5.2"},                                                      // '
    {1.4f, "M 1.4 7.8 C -.4 5.2 -.4 1.2 1.4 -1.4"},                               // (
    {1.4f, "M 0 7.8 C 1.8 5.2 1.8 1.2 0 -1.4"},                                   // )
    {2.6f, "M 1.3 7 L 1.3 4 M 0 6.25 L 2.6 4.75 M 0 4.75 L 2.6 6.25"},            // *
    {4.0f, "M 2 1.2 L 2 5.2 M 0 3.2 L 4 3.2"},                                    // +
    {0.5f, "M .5 .2 L 0 -1.4"},                                                   // ,
    {2.4f, "M 0 2.9 L 2.4 2.9"},                                                  // -
    {0.0f, "M 0 0 L 0 .2"},                                                       // .
    {2.9f, "M 0 -.8 L 2.9 7.6"},                                                  // /
    {4.0f, "E 2 3.5 2 3.5 0 360"},                                                // 0
    {4.0f, "M .5 5.5 L 2.3 7 L 2.3 0"},                                           // 1
    {4.0f, "E 2 5 2 2 165 -35 L 0 0 L 4 0"},                                      // 2
    {4.0f, "E 1.9 5.3 1.8 1.7 150 -90 e 1.9 1.8 2.1 1.8 90 -150"},                // 3
    {4.0f, "M 3.1 0 L 3.1 7 L 0 2 L 4.1 2"},                                      // 4
    {4.0f, "M 3.6 7 L .7 7 L .4 3.9 e 1.9 2.2 2.1 2.2 130 -150"},                 // 5
    {4.0f, "E 2 2.1 2 2.1 0 360 M 0 2.1 C 0 4.6 1.4 6.4 3.2 7"},                  // 6
    {4.0f, "M 0 7 L 4 7 L 1.4 0"},                                                // 7
    {4.0f, "E 2 5.3 1.7 1.7 0 360 E 2 1.8 2 1.8 0 360"},                          // 8
    {4.0f, "E 2 4.9 2 2.1 0 360 M 4 4.9 C 4 2.4 2.6 .6 .8 0"},                    // 9
    {0.0f, "M 0 4.4 L 0 4.6 M 0 0 L 0 .2"},                                       // :
    {0.5f, "M .5 4.4 L .5 4.6 M .5 .2 L 0 -1.4"},                                 // ;
    {3.8f, "M 3.8 5.4 L 0 3.2 L 3.8 1"},                                          // <
    {4.0f, "M 0 4.2 L 4 4.2 M 0 2.2 L 4 2.2"},                                    // =
    {3.8f, "M 0 5.4 L 3.8 3.2 L 0 1"},                                            // >
    {3.6f, "E 1.8 5.2 1.8 1.8 165 -50 C 2 3.2 1.7 2.9 1.7 2.2 M 1.7 0 L 1.7 .2"}, // ?
    {6.6f, "E 3.2 3.1 1.5 1.7 0 360 M 4.7 4.8 L 4.7 2.5 C 4.7 1 6.6 1 6.6 3.2 "
           "e 3.3 3.2 3.3 3.8 0 300"},                // @
    {5.0f, "M 0 0 L 2.5 7 L 5 0 M .9 2.4 L 4.1 2.4"}, // A
    {4.1f, "M 0 3.6 L 2.1 3.6 e 2.1 5.3 1.7 1.7 -90 90 L 0 7 L 0 0 L 2.3 0 "
           "e 2.3 1.8 1.8 1.8 -90 90"},                                               // B
    {4.6f, "E 2.7 3.5 2.7 3.5 48 312"},                                               // C
    {4.6f, "M 0 0 L 0 7 L 1.6 7 e 1.6 3.5 3 3.5 90 -90 L 0 0"},                       // D
    {3.7f, "M 3.7 7 L 0 7 L 0 0 L 3.7 0 M 0 3.6 L 3.2 3.6"},                          // E
    {3.6f, "M 3.6 7 L 0 7 L 0 0 M 0 3.5 L 3.2 3.5"},                                  // F
    {5.2f, "E 2.7 3.5 2.7 3.5 48 335 L 5.15 3.3 L 3 3.3"},                            // G
    {4.6f, "M 0 0 L 0 7 M 4.6 0 L 4.6 7 M 0 3.6 L 4.6 3.6"},                          // H
    {0.0f, "M 0 0 L 0 7"},                                                            // I
    {2.8f, "M 2.8 7 L 2.8 1.8 e 1.3 1.8 1.5 1.8 0 -150"},                             // J
    {4.3f, "M 0 0 L 0 7 M 4.1 7 L 0 2.6 M 1.5 4.2 L 4.3 0"},                          // K
    {3.5f, "M 0 7 L 0 0 L 3.5 0"},                                                    // L
    {5.6f, "M 0 0 L 0 7 L 2.8 2 L 5.6 7 L 5.6 0"},                                    // M
    {4.6f, "M 0 0 L 0 7 L 4.6 0 L 4.6 7"},                                            // N
    {5.4f, "E 2.7 3.5 2.7 3.5 0 360"},                                                // O
    {4.1f, "M 0 0 L 0 7 L 2.2 7 e 2.2 5.1 1.9 1.9 90 -90 L 0 3.2"},                   // P
    {5.4f, "E 2.7 3.5 2.7 3.5 0 360 M 3.4 1.8 L 5.3 -.5"},                            // Q
    {4.3f, "M 0 0 L 0 7 L 2.2 7 e 2.2 5.1 1.9 1.9 90 -90 L 0 3.2 M 2.2 3.2 L 4.3 0"}, // R
    {4.2f, "E 2.1 5.25 1.9 1.75 40 270 e 2.1 1.75 2.1 1.75 90 -140"},                 // S
    {4.8f, "M 0 7 L 4.8 7 M 2.4 7 L 2.4 0"},                                          // T
    {4.6f, "M 0 7 L 0 2.3 e 2.3 2.3 2.3 2.3 180 360 L 4.6 7"},                        // U
    {5.0f, "M 0 7 L 2.5 0 L 5 7"},                                                    // V
    {7.0f, "M 0 7 L 1.8 0 L 3.5 6 L 5.2 0 L 7 7"},                                    // W
    {4.6f, "M 0 7 L 4.6 0 M 4.6 7 L 0 0"},                                            // X
    {4.8f, "M 0 7 L 2.4 3.4 L 4.8 7 M 2.4 3.4 L 2.4 0"},                              // Y
    {4.5f, "M .2 7 L 4.4 7 L 0 0 L 4.5 0"},                                           // Z
    {1.3f, "M 1.3 7.6 L 0 7.6 L 0 -1.3 L 1.3 -1.3"},                                  // [
    {2.9f, "M 0 7.6 L 2.9 -.8"},                                                      // backslash
    {1.3f, "M 0 7.6 L 1.3 7.6 L 1.3 -1.3 L 0 -1.3"},                                  // ]
    {3.2f, "M 0 4.6 L 1.6 7 L 3.2 4.6"},                                              // ^
    {4.2f, "M 0 -1 L 4.2 -1"},                                                        // _
    {0.9f, "M 0 7.2 L .9 6"},                                                         // `
    {3.5f, "E 1.8 3.4 1.7 1.6 150 0 L 3.5 0 M 3.5 2.9 L 1.6 2.9 e 1.5 1.45 1.5 1.45 90 270 "
           "C 2.4 0 3.2 .5 3.5 1.4"},                                               // a
    {3.8f, "M 0 7 L 0 0 E 1.9 2.5 1.9 2.5 0 360"},                                  // b
    {3.5f, "E 2.1 2.5 2.1 2.5 48 312"},                                             // c
    {3.8f, "E 1.9 2.5 1.9 2.5 0 360 M 3.8 7 L 3.8 0"},                              // d
    {3.9f, "M 0 2.6 L 3.9 2.6 e 1.95 2.5 1.95 2.5 0 318"},                          // e
    {2.5f, "M 2.6 6.9 C 1.4 7.2 1 6.5 1 5.4 L 1 0 M 0 5 L 2.4 5"},                  // f
    {3.8f, "E 1.9 2.5 1.9 2.5 0 360 M 3.8 5 L 3.8 -.1 e 1.95 -.1 1.85 1.9 0 -150"}, // g
    {3.7f, "M 0 0 L 0 7 M 0 3 C 0 4.3 .9 5 2 5 C 3.2 5 3.7 4.2 3.7 3.1 L 3.7 0"},   // h
    {0.0f, "M 0 0 L 0 5 M 0 6.8 L 0 7"},                                            // i
    {0.9f, "M .9 5 L .9 -.6 C .9 -1.6 .4 -2 -.4 -2 M .9 6.8 L .9 7"},               // j
    {3.5f, "M 0 0 L 0 7 M 3.3 5 L 0 1.9 M 1.2 3 L 3.5 0"},                          // k
    {1.0f, "M 0 7 L 0 1.1 C 0 .3 .3 0 1 0"},                                        // l
    {5.8f, "M 0 0 L 0 5 M 0 3.2 C 0 4.3 .7 5 1.6 5 C 2.6 5 2.9 4.2 2.9 3.2 L 2.9 0 "
           "M 2.9 3.2 C 2.9 4.3 3.6 5 4.5 5 C 5.5 5 5.8 4.2 5.8 3.2 L 5.8 0"},      // m
    {3.7f, "M 0 0 L 0 5 M 0 3 C 0 4.3 .9 5 2 5 C 3.2 5 3.7 4.2 3.7 3.1 L 3.7 0"},   // n
    {4.0f, "E 2 2.5 2 2.5 0 360"},                                                  // o
    {3.8f, "M 0 5 L 0 -2 E 1.9 2.5 1.9 2.5 0 360"},                                 // p
    {3.8f, "E 1.9 2.5 1.9 2.5 0 360 M 3.8 5 L 3.8 -2"},                             // q
    {2.2f, "M 0 0 L 0 5 M 0 2.8 C 0 4.3 .8 5.1 2.2 4.95"},                          // r
    {3.3f, "E 1.65 3.75 1.5 1.25 35 270 e 1.65 1.25 1.65 1.25 90 -145"},            // s
    {2.5f, "M 1 6.6 L 1 1.4 C 1 .4 1.5 0 2.5 .1 M 0 5 L 2.4 5"},                    // t
    {3.7f, "M 0 5 L 0 1.9 C 0 .8 .5 0 1.7 0 C 2.8 0 3.7 .7 3.7 2 M 3.7 5 L 3.7 0"}, // u
    {3.8f, "M 0 5 L 1.9 0 L 3.8 5"},                                                // v
    {5.6f, "M 0 5 L 1.4 0 L 2.8 4.6 L 4.2 0 L 5.6 5"},                              // w
    {3.6f, "M 0 5 L 3.6 0 M 3.6 5 L 0 0"},                                          // x
    {3.8f, "M 0 5 L 1.9 0 M 3.8 5 L 1.9 0 L 1.3 -1.4 C 1.1 -1.9 .7 -2.1 0 -2"},     // y
    {3.5f, "M .1 5 L 3.4 5 L 0 0 L 3.5 0"},                                         // z
    {1.8f, "M 1.8 7.8 C .2 7.8 1.6 3.2 0 3.2 C 1.6 3.2 .2 -1.4 1.8 -1.4"},          // {
    {0.0f, "M 0 7.8 L 0 -1.6"},                                                     // |
    {1.8f, "M 0 7.8 C 1.6 7.8 .2 3.2 1.8 3.2 C .2 3.2 1.6 -1.4 0 -1.4"},            // }
    {4.2f, "M 0 2.6 C 1 4.6 3.2 1.6 4.2 3.6"},                                      // ~
}};
// clang-format on

constexpr Glyph kUnknown = {3.6f, "M 0 0 L 0 7 L 3.6 7 L 3.6 0 L 0 0"};
constexpr float kSpacing = 1.75f;

const Glyph& glyphOf(char c) {
    const auto code = static_cast<unsigned char>(c);
    return code >= 32 && code < 127 ? kGlyphs[code - 32u] : kUnknown;
}

/// Reads one path and appends its strokes, moved to the right.
class PathReader {
public:
    PathReader(const char* path, float offset, std::vector<Polyline>& strokes)
        : at_(path), offset_(offset), strokes_(strokes) {}

    void read() {
        while (const char command = next()) {
            if (command == 'M')
                strokes_.push_back({point()});
            else if (command == 'L')
                strokes_.back().push_back(point());
            else if (command == 'C')
                curve();
            else
                arc(command == 'e');
        }
    }

private:
    char next() {
        while (*at_ == ' ')
            ++at_;
        return *at_ ? *at_++ : '\0';
    }

    float number() {
        char* end = nullptr;
        const float value = std::strtof(at_, &end);
        at_ = end;
        return value;
    }

    glm::vec2 point() {
        const float x = number(), y = number();
        return {x + offset_, y};
    }

    void curve() {
        constexpr int kPieces = 12;
        const glm::vec2 a = strokes_.back().back(), b = point(), c = point(), d = point();
        for (int i = 1; i <= kPieces; ++i) {
            const float t = float(i) / kPieces, s = 1.0f - t;
            strokes_.back().push_back(s * s * s * a + 3.0f * s * s * t * b + 3.0f * s * t * t * c +
                                      t * t * t * d);
        }
    }

    void arc(bool continues) {
        const glm::vec2 center = point();
        const float rx = number(), ry = number(), from = number(), to = number();
        if (!continues)
            strokes_.emplace_back();
        const int pieces = std::max(4, int(std::abs(to - from) / 10.0f));
        for (int i = 0; i <= pieces; ++i) {
            const float degrees = from + (to - from) * float(i) / float(pieces);
            const float angle = degrees * float(std::numbers::pi / 180.0);
            strokes_.back().push_back(center +
                                      glm::vec2(rx * std::cos(angle), ry * std::sin(angle)));
        }
    }

    const char* at_;
    float offset_;
    std::vector<Polyline>& strokes_;
};

} // namespace

std::vector<Polyline> textStrokes(std::string_view text) {
    std::vector<Polyline> strokes;
    float x = 0.0f;
    for (const char c : text) {
        PathReader(glyphOf(c).path, x, strokes).read();
        x += glyphOf(c).width + kSpacing;
    }
    return strokes;
}

float textWidth(std::string_view text) {
    float width = 0.0f;
    for (const char c : text)
        width += glyphOf(c).width + kSpacing;
    return text.empty() ? 0.0f : width - kSpacing;
}

} // namespace afterglow
