// SPDX-License-Identifier: MIT
#include "app/report/canvas.h"
#include "app/report/contact_sheet.h"

#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

/// A picture whose pixels all differ, in a color range that the sheet itself does not use.
Image<glm::u8vec4> picture(glm::ivec2 size, int seed = 0) {
    Image<glm::u8vec4> image(size);
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x)
            image({x, y}) = glm::u8vec4(255, x % 256, (y + seed) % 256, 255);
    }
    return image;
}

bool isAt(const Image<glm::u8vec4>& sheet, const Image<glm::u8vec4>& part, glm::ivec2 corner) {
    for (int y = 0; y < part.size().y; ++y) {
        for (int x = 0; x < part.size().x; ++x) {
            const glm::ivec2 p = corner + glm::ivec2(x, y);
            if (!sheet.contains(p) || sheet(p) != part({x, y}))
                return false;
        }
    }
    return true;
}

int placesOf(const Image<glm::u8vec4>& part, const Image<glm::u8vec4>& sheet) {
    int places = 0;
    for (int y = 0; y < sheet.size().y; ++y) {
        for (int x = 0; x < sheet.size().x; ++x)
            places += isAt(sheet, part, {x, y});
    }
    return places;
}

ContactSheet small() {
    ContactSheet sheet{.title = "light-off"};
    sheet.columns = {"frame 3", "frame 4"};
    sheet.eventColumn = 1;
    sheet.rows = {{.name = "svgf", .color = sheetColor(0)},
                  {.name = "asvgf", .color = sheetColor(1)}};
    for (int i = 0; i < 4; ++i)
        sheet.rows[std::size_t(i / 2)].pictures.push_back(picture({131, 125}, 50 * i));
    return sheet;
}

/// Whether any pixel has exactly this color.
bool shows(const Image<glm::u8vec4>& image, glm::u8vec3 color) {
    return std::any_of(image.pixels().begin(), image.pixels().end(),
                       [&](const glm::u8vec4& pixel) { return glm::u8vec3(pixel) == color; });
}

} // namespace

TEST_CASE("every picture is on the contact sheet once, pixel for pixel, and none over another") {
    const ContactSheet sheet = small();
    const Image<glm::u8vec4> drawn = drawContactSheet(sheet);
    for (const SheetRow& row : sheet.rows) {
        for (const auto& part : row.pictures)
            CHECK(placesOf(part, drawn) == 1);
        CHECK(shows(drawn, row.color));
    }
    CHECK_FALSE(shows(drawn, sheetColor(2)));
}

TEST_CASE("large pictures are averaged by whole blocks, small ones enlarged by whole pixels") {
    ContactSheet sheet{.title = ""};
    sheet.columns = {""};
    sheet.rows = {{.name = ""}};

    Image<glm::u8vec4> large({641, 5}, glm::u8vec4(255, 10, 0, 255)); // by 3: 214 x 2
    large({0, 0}) = {255, 100, 0, 255};
    sheet.rows[0].pictures = {large};
    Image<glm::u8vec4> expected({214, 2}, glm::u8vec4(255, 10, 0, 255));
    expected({0, 0}).g = 20; // (100 + 8 * 10) / 9
    CHECK(placesOf(expected, drawContactSheet(sheet)) == 1);

    sheet.rows[0].pictures = {picture({61, 37})}; // by 2
    Image<glm::u8vec4> twice({122, 74});
    for (int y = 0; y < 74; ++y) {
        for (int x = 0; x < 122; ++x)
            twice({x, y}) = sheet.rows[0].pictures[0]({x / 2, y / 2});
    }
    CHECK(placesOf(twice, drawContactSheet(sheet)) == 1);
}

TEST_CASE("a picture that is missing leaves its place blank") {
    ContactSheet sheet = small();
    const glm::ivec2 size = drawContactSheet(sheet).size();
    const Image<glm::u8vec4> last = sheet.rows[1].pictures[1];
    sheet.rows[1].pictures[0] = {};
    sheet.rows[0].pictures.pop_back();
    const Image<glm::u8vec4> drawn = drawContactSheet(sheet);
    CHECK(drawn.size() == size);
    CHECK(placesOf(last, drawn) == 1);
}

TEST_CASE("curves of any values are drawn inside their sheet, in their color") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    ContactSheet sheet = small();
    const glm::ivec2 without = drawContactSheet(sheet).size();
    SheetPlot plot{.title = "response", .levels = {{0.9, "90 %"}}, .events = {4}};
    plot.curves = {{.name = "a", .color = {1, 2, 250}, .firstFrame = 2, .values = {0.0, 0.5, 1.0}},
                   {.name = "b", .color = {1, 250, 2}, .values = {nan, 1e30, -1e30, nan, 0.5}},
                   {.name = "c", .values = {}}};
    plot.curves[0].marked = 3;
    plot.curves[0].mark = "t50 = 1";
    plot.curves[1].marked = 1000; // beyond its values: no mark
    sheet.plots = {plot, {.title = "empty"}};
    const Image<glm::u8vec4> drawn = drawContactSheet(sheet);
    CHECK(drawn.size().x == without.x);
    CHECK(drawn.size().y > without.y);
    CHECK(shows(drawn, {1, 2, 250}));
    CHECK(shows(drawn, {1, 250, 2}));

    const Image<glm::u8vec4> again = drawContactSheet(sheet);
    CHECK(std::equal(again.pixels().begin(), again.pixels().end(), drawn.pixels().begin()));
}

TEST_CASE("a sheet whose pictures do not fit together is our mistake") {
    ContactSheet sheet = small();
    sheet.rows[0].pictures.push_back(picture({131, 125}));
    CHECK_THROWS_AS(drawContactSheet(sheet), std::logic_error);
    sheet = small();
    sheet.rows[0].pictures[1] = picture({130, 125});
    CHECK_THROWS_AS(drawContactSheet(sheet), std::logic_error);
    CHECK(drawContactSheet({.title = "nothing at all"}).size().x > 0);
}

TEST_CASE("a text in any alphabet of the typeface has its letters, and what it lacks is a box") {
    const auto lettersOf = [](std::string_view text) {
        return glyphsOf(text, 16.0f, Weight::Regular, 0.0f);
    };
    const auto pixelsOf = [](const Glyph& glyph) {
        return std::vector(glyph.coverage.pixels().begin(), glyph.coverage.pixels().end());
    };
    const auto shapeOf = [&](std::string_view text) { return pixelsOf(lettersOf(text).at(0)); };
    const auto box = shapeOf("\u4e2d"); // Roboto has no Chinese
    CHECK(box == shapeOf("\u6587"));
    CHECK(std::ranges::max(box) > 100);
    for (const char* letter : {"L", "\u00e4", "\u2014", "\u00e9", "\u03bb", "\u2019"})
        CHECK(shapeOf(letter) != box);
    CHECK(lettersOf("L\u00e4mpchen \u2014 \u00e9\u00e9n").size() == 12); // spaces have none
    CHECK(lettersOf("\u00e4")[0].corner.y < lettersOf("a")[0].corner.y); // the dots are above it

    // Each byte that is no UTF-8 is a character, and the next letter is itself again.
    const std::string broken = "\303a\342\202a\377";
    CHECK(lettersOf(broken).size() == 6);
    CHECK(shapeOf(broken) == shapeOf("\xff"));
    CHECK(shapeOf(broken.substr(1)) == shapeOf("a"));
}

TEST_CASE("a text is as wide as its letters reach, and figures line up") {
    const auto width = [](std::string_view text, Weight weight = Weight::Regular) {
        return textWidth(text, 20.0f, weight);
    };
    CHECK(width("") == 0.0f);
    CHECK(width("ab") == doctest::Approx(width("a") + width("b")).epsilon(0.02));
    CHECK(width("AV") < width("A") + width("V")); // set closer
    for (const char figure : std::string("023456789"))
        CHECK(width(std::string(1, figure)) == width("1"));
    CHECK(width("text", Weight::Medium) > width("text"));
    for (const std::string text : {"W", "response", "\u00e9\u00e9n"})
        for (const Glyph& glyph : glyphsOf(text, 20.0f, Weight::Regular, 0.0f)) {
            CHECK(glyph.corner.x >= -1);
            CHECK(glyph.corner.x + glyph.coverage.size().x <= width(text) + 1.0f);
        }
}

TEST_CASE("a title in another language is drawn, in its color and with smooth edges") {
    ContactSheet sheet{.title = "L\u00e4mpchen \u2014 \u00e9\u00e9n"};
    const Image<glm::u8vec4> drawn = drawContactSheet(sheet);
    sheet.title = "Lampchen - een";
    const Image<glm::u8vec4> plain = drawContactSheet(sheet);
    CHECK_FALSE(std::ranges::equal(plain.pixels(), drawn.pixels()));
    std::set<int> levels;
    for (const glm::u8vec4& pixel : drawn.pixels())
        levels.insert(pixel.r);
    CHECK(shows(drawn, {236, 239, 244})); // strokes are wide enough to be whole somewhere
    CHECK(levels.size() > 20);
}

TEST_CASE("a straight line covers as much as its width says, and overlaps do not add up") {
    Canvas canvas({40, 20}, {0, 0, 0});
    const Polyline cross[] = {{{5.0f, 10.0f}, {35.0f, 10.0f}}, {{5.0f, 10.0f}, {35.0f, 10.0f}}};
    canvas.stroke(cross, 3.0f, {200, 200, 200}, 0.5f);
    int column = 0;
    for (int y = 0; y < 20; ++y)
        column += canvas.image()({20, y}).r;
    CHECK(column == 300); // 3 pixels, half of 200 each
    CHECK(canvas.image()({20, 10}).r == 100);
    CHECK(canvas.image()({0, 10}).r == 0);

    canvas.fill({-5, -5}, {1000, 1000}, {7, 7, 7}); // what lies outside is left out
    canvas.line({-1e4f, 10.0f}, {1e4f, 10.0f}, 2.0f, {9, 9, 9});
    canvas.text({30.0f, 10.0f}, "beyond the edge", {});
    CHECK(canvas.image()({1, 1}).r == 7);
}
