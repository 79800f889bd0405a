// SPDX-License-Identifier: MIT
#include "app/workbench/layout.h"
#include "window_hands.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace afterglow;

namespace {

std::int64_t areaOf(const Rect& rect) {
    return std::int64_t(rect.size.x) * rect.size.y;
}

bool overlap(const Rect& a, const Rect& b) {
    return !a.empty() && !b.empty() && a.min.x < b.min.x + b.size.x &&
           b.min.x < a.min.x + a.size.x && a.min.y < b.min.y + b.size.y &&
           b.min.y < a.min.y + a.size.y;
}

std::vector<Rect> partsOf(const Layout& layout) {
    return {layout.panel, layout.side, layout.curves, layout.strip, layout.view};
}

constexpr glm::ivec2 kWindows[] = {{0, 0},      {1, 1},      {2, 300},    {300, 2},
                                   {97, 97},    {500, 300},  {557, 611},  {800, 601},
                                   {1091, 767}, {1093, 803}, {1600, 900}, {4001, 2003}};

/// Everything that can be shown or not; also a side narrower than the picture must be.
std::vector<LayoutWishes> allWishes() {
    std::vector<LayoutWishes> all;
    for (const int panel : {0, 372, 11})
        for (const int side : {0, 348, 100})
            for (const int curves : {0, 240})
                for (const int strip : {0, 70, 400})
                    all.push_back({panel, side, curves, strip});
    return all;
}

} // namespace

TEST_CASE("the parts of a window fill it and none overlaps, at any size and with any wishes") {
    for (const glm::ivec2 window : kWindows)
        for (const LayoutWishes& wishes : allWishes()) {
            CAPTURE(window.x);
            CAPTURE(window.y);
            CAPTURE(wishes.panel);
            CAPTURE(wishes.side);
            CAPTURE(wishes.curves);
            CAPTURE(wishes.strip);
            const auto parts = partsOf(layoutOf(window, wishes));
            std::int64_t area = 0;
            for (std::size_t i = 0; i < parts.size(); ++i) {
                area += areaOf(parts[i]);
                CHECK(glm::all(glm::greaterThanEqual(parts[i].size, glm::ivec2(0))));
                CHECK((parts[i].empty() ||
                       (glm::all(glm::greaterThanEqual(parts[i].min, glm::ivec2(0))) &&
                        glm::all(glm::lessThanEqual(parts[i].min + parts[i].size, window)))));
                for (std::size_t j = 0; j < i; ++j)
                    CHECK_FALSE(overlap(parts[i], parts[j]));
            }
            CHECK(area == std::int64_t(window.x) * window.y);
        }
}

TEST_CASE("what is shown has the room it wants and leaves room for a picture") {
    for (const glm::ivec2 window : kWindows)
        for (const LayoutWishes& wishes : allWishes()) {
            CAPTURE(window.x);
            CAPTURE(window.y);
            const Layout layout = layoutOf(window, wishes);
            for (const auto& [has, wants] : {std::pair(layout.panel.size.x, wishes.panel),
                                             {layout.side.size.x, wishes.side},
                                             {layout.curves.size.y, wishes.curves},
                                             {layout.strip.size.y, wishes.strip}})
                CHECK((has == 0 || has == wants));
            if (!layout.panel.empty() || !layout.side.empty())
                CHECK(layout.view.size.x >= std::max(wishes.panel / 2, 1));
            if (!layout.curves.empty() || !layout.strip.empty())
                CHECK(layout.view.size.y >= 96);
            // The side goes before the panel, the curves before the strip.
            CHECK((layout.side.empty() || wishes.panel == 0 || !layout.panel.empty()));
            CHECK((layout.curves.empty() || wishes.strip == 0 || !layout.strip.empty()));
        }
}

TEST_CASE("in a window that is large enough all wishes come true") {
    const Layout layout = layoutOf({1600, 900}, {372, 348, 240, 70});
    CHECK(layout.panel == Rect{{0, 0}, {372, 900}});
    CHECK(layout.side == Rect{{1252, 0}, {348, 900}});
    CHECK(layout.view == Rect{{372, 0}, {880, 590}});
    CHECK(layout.curves == Rect{{372, 590}, {880, 240}});
    CHECK(layout.strip == Rect{{372, 830}, {880, 70}});
}

TEST_CASE("a fitted picture lies in the middle, inside, with its proportions to half a pixel") {
    for (const glm::ivec2 area : {glm::ivec2(1600, 900), {101, 77}, {1, 1}, {1, 900}, {333, 2}})
        for (const glm::ivec2 image :
             {glm::ivec2(640, 360), {61, 37}, {1, 1}, {1, 1000}, {16384, 1}}) {
            CAPTURE(area.x);
            CAPTURE(area.y);
            CAPTURE(image.x);
            CAPTURE(image.y);
            const Rect fitted = fitAspect({{7, 3}, area}, image);
            const glm::ivec2 before = fitted.min - glm::ivec2(7, 3);
            const glm::ivec2 after = area - before - fitted.size;
            CHECK(glm::all(glm::greaterThanEqual(before, glm::ivec2(0))));
            CHECK(glm::all(glm::lessThanEqual(glm::abs(after - before), glm::ivec2(1))));
            CHECK((before.x == 0 || before.y == 0));
            CHECK(glm::all(glm::greaterThan(fitted.size, glm::ivec2(0))));
            const double scale = std::min(double(area.x) / image.x, double(area.y) / image.y);
            CHECK(std::abs(fitted.size.x - std::max(scale * image.x, 1.0)) <= 0.5);
            CHECK(std::abs(fitted.size.y - std::max(scale * image.y, 1.0)) <= 0.5);
        }
    CHECK(fitAspect({{0, 0}, {0, 0}}, {4, 3}).empty());
    CHECK(fitAspect({{0, 0}, {8, 8}}, {0, 3}).empty());
}

TEST_CASE(
    "the render size follows the window or not, and is zero only when the window is minimized") {
    Resolution resolution{.followWindow = true, .scale = 0.5f};
    CHECK(renderSize(resolution, {101, 33}) == glm::ivec2(51, 17));
    CHECK(renderSize(resolution, {1, 1}) == glm::ivec2(1, 1));
    CHECK(renderSize(resolution, {0, 20}) == glm::ivec2(0));
    resolution.followWindow = false;
    CHECK(renderSize(resolution, {101, 33}) == resolution.fixed);
    CHECK(renderSize(resolution, {0, 0}) == glm::ivec2(0));
    CHECK(startResolution(false, {4000, 2000}).followWindow);
    CHECK_FALSE(startResolution(true, {1228, 900}).followWindow);
    CHECK(startResolution(true, {240, 160}).followWindow);
}

TEST_CASE("plus and minus go through the resolutions of one kind and stop at both ends") {
    for (const bool follows : {true, false}) {
        ViewState state = cornellState();
        state.resolution = {.followWindow = follows, .scale = 0.6f, .fixed = {700, 400}};
        std::size_t steps = 0;
        for (int i = 0; i < 20; ++i)
            press(state, '-');
        for (Resolution before;; ++steps) {
            before = state.resolution;
            press(state, '=');
            if (state.resolution == before)
                break;
            CHECK(renderSize(state.resolution, {800, 600}).x > renderSize(before, {800, 600}).x);
        }
        CHECK(state.resolution.followWindow == follows);
        CHECK(steps + 1 ==
              std::size_t(std::ranges::count_if(resolutions(), [&](const auto& choice) {
                  return choice.resolution.followWindow == follows;
              })));
    }
}
