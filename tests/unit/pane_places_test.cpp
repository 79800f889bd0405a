// SPDX-License-Identifier: MIT
#include "app/workbench/panes.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

constexpr glm::ivec2 kImage{61, 37};

Panes panesIn(PaneLayout layout) {
    Panes panes = startPanes(Settings{});
    panes.pair = {2, 1};
    panes.active = 1;
    chooseLayout(panes, layout);
    panes.divider = 0.37f;
    return panes;
}

template <class Check>
void forEachLayout(const Check& check) {
    for (std::size_t i = 0; i < kPaneLayouts; ++i) {
        const PaneLayout layout{int(i)};
        CAPTURE(nameOf(layout));
        check(layout);
    }
}

bool contains(const Rect& outer, const Rect& inner) {
    return glm::all(glm::greaterThanEqual(inner.min, outer.min)) &&
           glm::all(glm::lessThanEqual(inner.min + inner.size, outer.min + outer.size));
}

bool contains(const Rect& rect, glm::vec2 position) {
    return glm::all(glm::greaterThanEqual(position, glm::vec2(rect.min))) &&
           glm::all(glm::lessThan(position, glm::vec2(rect.min + rect.size)));
}

} // namespace

TEST_CASE("the places of the panes cover the view without overlap, and hold their pictures") {
    for (const glm::ivec2 size :
         {glm::ivec2(0, 0), {1, 1}, {2, 1}, {3, 5}, {61, 37}, {101, 77}, {1231, 683}})
        for (const glm::ivec2 image : {kImage, glm::ivec2(1, 1), {16, 900}})
            forEachLayout([&](PaneLayout layout) {
                CAPTURE(size.x);
                CAPTURE(size.y);
                const Rect view{{5, 11}, size};
                const Panes panes = panesIn(layout);
                const auto places = placesOf(panes, view, image);
                std::set<std::size_t> shown;
                for (const PanePlace& place : places) {
                    shown.insert(place.pane);
                    CHECK(contains(view, place.cell));
                    CHECK(contains(place.cell, place.picture));
                    CHECK(contains(place.picture, place.shown));
                    CHECK((place.picture.empty() == place.cell.empty() || size.x == 1 ||
                           size.y == 1)); // one pixel has no two equal parts
                }
                CHECK(shown.size() == places.size());
                for (const std::size_t pane : shown)
                    CHECK(isShown(panes, pane));
                // A wipe's two lie on each other.
                const bool beside = layout != PaneLayout::Wipe;
                for (int y = 0; beside && y < std::min(size.y, 90); ++y)
                    for (int x = 0; x < std::min(size.x, 110); ++x) {
                        const glm::vec2 position = glm::vec2(view.min) + glm::vec2(x, y) + 0.5f;
                        REQUIRE(std::ranges::count_if(places, [&](const PanePlace& place) {
                                    return contains(place.cell, position);
                                }) == 1);
                    }
                std::int64_t area = 0;
                for (const PanePlace& place : places)
                    area += std::int64_t(place.cell.size.x) * place.cell.size.y;
                CHECK(area == (beside ? 1 : 2) * std::int64_t(size.x) * size.y);
            });
}

TEST_CASE("pictures that are compared are of exactly one size, and in the order shown") {
    forEachLayout([](PaneLayout layout) {
        const Panes panes = panesIn(layout);
        const auto places = placesOf(panes, {{0, 0}, {1231, 683}}, kImage);
        const auto shown = shownPanes(panes);
        for (std::size_t i = 0; i < places.size(); ++i) {
            CHECK(places[i].pane == shown[i]);
            CHECK(places[i].picture.size == places[0].picture.size);
        }
    });
    // The first is on the left, or in the upper row.
    const auto two = placesOf(panesIn(PaneLayout::TwoUp), {{0, 0}, {200, 100}}, kImage);
    CHECK(two[0].cell.min.x < two[1].cell.min.x);
    const auto four = placesOf(panesIn(PaneLayout::FourUp), {{0, 0}, {200, 100}}, kImage);
    CHECK(four[1].cell.min.x > four[0].cell.min.x);
    CHECK(four[2].cell.min.y > four[0].cell.min.y);
    CHECK(four[3].cell.min == glm::ivec2(100, 50));
}

TEST_CASE("the parts of a wipe join exactly at the divider, wherever it is") {
    Panes panes = panesIn(PaneLayout::Wipe);
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {61, 37}, {101, 300}})
        for (int step = 0; step <= 50; ++step) {
            panes.divider = float(step) / 50.0f;
            CAPTURE(size.x);
            CAPTURE(panes.divider);
            const auto places = placesOf(panes, {{3, 4}, size}, kImage);
            REQUIRE(places.size() == 2);
            const Rect &left = places[0].shown, &right = places[1].shown,
                       &picture = places[0].picture;
            CHECK(places[1].picture == picture);
            CHECK(left.min == picture.min);
            CHECK(left.min.x + left.size.x == right.min.x);
            CHECK(right.min + right.size == picture.min + picture.size);
            CHECK(left.size.y == right.size.y);
            const float x = float(picture.min.x) + panes.divider * float(picture.size.x);
            CHECK(std::abs(float(right.min.x) - x) <= 0.5f);
            if (step == 0)
                CHECK(left.empty());
            if (step == 50)
                CHECK(right.empty());
        }
}

TEST_CASE("every pixel is found at its position, in every layout, enlarged or not") {
    for (const Rect view :
         {Rect{{7, 3}, {373, 131}}, Rect{{7, 3}, {61, 37}}, Rect{{0, 0}, {40, 90}}})
        forEachLayout([&](PaneLayout layout) {
            const auto places = placesOf(panesIn(layout), view, kImage);
            std::size_t hidden = 0;
            for (const PanePlace& place : places)
                for (int y = 0; y < kImage.y; ++y)
                    for (int x = 0; x < kImage.x; ++x) {
                        const glm::vec2 position =
                            positionOf(place, glm::vec2(x, y) + 0.5f, kImage);
                        const auto found = pixelAt(places, position, kImage);
                        REQUIRE(found);
                        REQUIRE(found->pixel == glm::ivec2(x, y));
                        REQUIRE((found->pane == place.pane) == contains(place.shown, position));
                        hidden += found->pane != place.pane;
                    }
            // Of the two pictures of a wipe, one is seen.
            CHECK(hidden == (layout == PaneLayout::Wipe ? std::size_t(kImage.x * kImage.y) : 0));
        });
}

TEST_CASE("every position of the view shows the pixel whose square it is in, or no picture") {
    forEachLayout([](PaneLayout layout) {
        const Rect view{{7, 3}, {173, 131}};
        const auto places = placesOf(panesIn(layout), view, kImage);
        for (int y = -2; y < 2 * view.size.y + 2; ++y) // edges and centers of its pixels
            for (int x = -2; x < 2 * view.size.x + 2; ++x) {
                const glm::vec2 position = glm::vec2(view.min) + 0.5f * glm::vec2(x, y);
                const auto place = std::ranges::find_if(
                    places, [&](const PanePlace& p) { return contains(p.shown, position); });
                const auto found = pixelAt(places, position, kImage);
                REQUIRE(found.has_value() == (place != places.end()));
                if (!found)
                    continue;
                REQUIRE(found->pane == place->pane);
                constexpr float kRounding = 1e-3f;
                const glm::vec2 low = positionOf(*place, found->pixel, kImage) - kRounding;
                const glm::vec2 high = positionOf(*place, found->pixel + 1, kImage) + kRounding;
                REQUIRE(glm::all(glm::lessThanEqual(low, position)));
                REQUIRE(glm::all(glm::lessThanEqual(position, high)));
            }
    });
    CHECK_FALSE(pixelAt({}, {1.0f, 1.0f}, kImage));
}

TEST_CASE("a divider goes where it is dragged, and not out of the picture") {
    Panes panes = panesIn(PaneLayout::Wipe);
    const auto places = placesOf(panes, {{7, 3}, {173, 131}}, kImage);
    const Rect& picture = places[0].picture;
    const float y = float(picture.min.y) + 0.5f, end = float(picture.min.x + picture.size.x);
    for (float x = float(picture.min.x); x <= end; x += 0.75f) {
        panes.divider = dividerAt(places, {x, y});
        CHECK(isOnDivider(panes, places, {x, y}, 0.01f));
        CHECK(isOnDivider(panes, places, {x + 5.0f, y}, 6.0f));
        CHECK_FALSE(isOnDivider(panes, places, {x + 7.0f, y}, 6.0f));
        CHECK_FALSE(isOnDivider(panes, places, {x, float(picture.min.y) - 1.0f}, 6.0f));
        CHECK_FALSE(isOnDivider(panes, places, {x, float(picture.min.y + picture.size.y)}, 6.0f));
    }
    CHECK(dividerAt(places, {-1e4f, y}) == 0.0f);
    CHECK(dividerAt(places, {1e4f, y}) == 1.0f);
    CHECK(dividerAt({}, {3.0f, 3.0f}) == 0.5f);
    forEachLayout([](PaneLayout layout) {
        const Panes others = panesIn(layout);
        const auto where = placesOf(others, {{0, 0}, {100, 60}}, kImage);
        CHECK(isOnDivider(others, where, {37.0f, 30.0f}, 6.0f) == (layout == PaneLayout::Wipe));
    });
}
