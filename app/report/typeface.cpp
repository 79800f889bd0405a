// SPDX-License-Identifier: MIT
#include "app/report/typeface.h"

#include "app/base/embedded.h"

#include <cmath>
#include <stdexcept>

#include <stb_truetype.h>

namespace afterglow {
namespace {

constexpr char32_t kNoCharacter = 0xfffd;

const stbtt_fontinfo& fontOf(Weight weight) {
    const auto load = [](const EmbeddedFile& file) {
        stbtt_fontinfo font{};
        const auto* bytes = reinterpret_cast<const unsigned char*>(file.bytes.data());
        if (!stbtt_InitFont(&font, bytes, 0))
            throw std::logic_error(std::string(file.name) + " is not a font");
        return font;
    };
    static const stbtt_fontinfo fonts[] = {load(embeddedFonts()[0]), load(embeddedFonts()[1])};
    return fonts[weight == Weight::Medium];
}

/// Cuts the first character off a text that is not empty.
char32_t nextCharacter(std::string_view& text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(0);
    const std::size_t length = lead < 0x80             ? 1
                               : (lead & 0xe0) == 0xc0 ? 2
                               : (lead & 0xf0) == 0xe0 ? 3
                               : (lead & 0xf8) == 0xf0 ? 4
                                                       : 0;
    char32_t character = length == 1 ? lead : lead & (0x7f >> length);
    bool isWhole = length > 0 && length <= text.size();
    for (std::size_t i = 1; isWhole && i < length; ++i) {
        isWhole = (byte(i) & 0xc0) == 0x80;
        character = character << 6 | (byte(i) & 0x3f);
    }
    text.remove_prefix(isWhole ? length : 1);
    return isWhole ? character : kNoCharacter;
}

/// Calls place(glyph, x) for each character of the text, and returns where the next would begin.
template <class Place>
float typeset(std::string_view text, float size, Weight weight, float x, Place place) {
    const stbtt_fontinfo& font = fontOf(weight);
    const float scale = stbtt_ScaleForMappingEmToPixels(&font, size);
    int before = 0;
    while (!text.empty()) {
        const int glyph = stbtt_FindGlyphIndex(&font, int(nextCharacter(text)));
        if (before != 0)
            x += scale * float(stbtt_GetGlyphKernAdvance(&font, before, glyph));
        place(glyph, x);
        int advance = 0, bearing = 0;
        stbtt_GetGlyphHMetrics(&font, glyph, &advance, &bearing);
        x += scale * float(advance);
        before = glyph;
    }
    return x;
}

} // namespace

std::vector<Glyph> glyphsOf(std::string_view text, float size, Weight weight, float x) {
    const stbtt_fontinfo& font = fontOf(weight);
    const float scale = stbtt_ScaleForMappingEmToPixels(&font, size);
    std::vector<Glyph> glyphs;
    typeset(text, size, weight, x, [&](int glyph, float at) {
        const float left = std::floor(at), shift = at - left;
        glm::ivec2 low(0), high(0);
        stbtt_GetGlyphBitmapBoxSubpixel(&font, glyph, scale, scale, shift, 0.0f, &low.x, &low.y,
                                        &high.x, &high.y);
        if (low.x >= high.x || low.y >= high.y)
            return; // a space
        Image<std::uint8_t> coverage(high - low);
        stbtt_MakeGlyphBitmapSubpixel(&font, coverage.pixels().data(), high.x - low.x,
                                      high.y - low.y, high.x - low.x, scale, scale, shift, 0.0f,
                                      glyph);
        glyphs.push_back({low + glm::ivec2(int(left), 0), std::move(coverage)});
    });
    return glyphs;
}

float textWidth(std::string_view text, float size, Weight weight) {
    return typeset(text, size, weight, 0.0f, [](int, float) {});
}

} // namespace afterglow
