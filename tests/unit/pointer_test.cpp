// SPDX-License-Identifier: MIT
#include "app/workbench/pointer.h"
#include "window_hands.h"

#include <algorithm>

using namespace afterglow;

namespace {

constexpr glm::ivec2 kImage{61, 37};
constexpr Rect kView{{20, 10}, {400, 300}};

/// A mouse over the panes of a state.
struct Mouse {
    ViewState state = cornellState();
    Pointer pointer;
    bool overPanel = false, shift = false, control = false;
    glm::ivec2 image = kImage;

    explicit Mouse(PaneLayout layout = PaneLayout::Single) { chooseLayout(state.panes, layout); }

    std::vector<PanePlace> places() const { return placesOf(state.panes, kView, kImage); }
    glm::vec2 over(std::size_t pane, glm::ivec2 pixel) const {
        const auto all = places();
        const auto place = std::ranges::find(all, pane, &PanePlace::pane);
        REQUIRE(place != all.end());
        return positionOf(*place, glm::vec2(pixel) + 0.5f, kImage);
    }

    void round(glm::vec2 position, bool pressed = false, bool released = false) {
        movePointer(pointer, state,
                    {.position = position,
                     .pressed = pressed,
                     .released = released,
                     .adds = shift,
                     .exact = control,
                     .onPicture = !overPanel},
                    places(), image);
    }
    void click(glm::vec2 position) {
        round(position, true);
        round(position, false, true);
    }
    void drag(glm::vec2 from, glm::vec2 to) {
        round(from, true);
        round(0.5f * (from + to));
        round(to);
        round(to, false, true);
    }

    std::size_t probes() const {
        return std::size_t(std::ranges::count_if(
            state.probes, [](const auto& probe) { return probe.has_value(); }));
    }
    Probe probe(std::size_t index) const {
        REQUIRE(state.probes.at(index));
        CHECK(state.probes[index]->image == kImage);
        return state.probes[index]->probe;
    }
};

} // namespace

TEST_CASE("a click sets a box of nine by nine around its pixel, inside the picture") {
    Mouse mouse(PaneLayout::FourUp);
    for (const std::size_t pane : {3u, 1u, 0u, 2u})
        for (const auto& [pixel, corner] : {std::pair(glm::ivec2(0, 0), glm::ivec2(0, 0)),
                                            {{60, 36}, {52, 28}},
                                            {{17, 5}, {13, 1}}}) {
            mouse.click(mouse.over(pane, pixel));
            CHECK(mouse.probe(0) == Probe{corner, {9, 9}});
            CHECK(mouse.state.panes.active == pane);
            CHECK(mouse.probes() == 1);
        }
    CHECK(mouse.state.showCurves);
    CHECK(mouse.pointer.holds == Pointer::Holds::Nothing);
}

TEST_CASE("a click with Control held is exactly its pixel") {
    Mouse mouse;
    mouse.control = true;
    mouse.click(mouse.over(0, {17, 5}));
    CHECK(mouse.probe(0) == Probe{{17, 5}, {1, 1}});
}

TEST_CASE("a click within one round is a click, and so is one whose hand trembles") {
    Mouse mouse;
    mouse.round(mouse.over(0, {14, 9}), true, true);
    CHECK(mouse.probe(0) == Probe{{10, 5}, {9, 9}});
    const PanePlace place = mouse.places()[0];
    const glm::vec2 edge = positionOf(place, {20.0f, 9.5f}, kImage);
    mouse.drag(edge + glm::vec2(0.5f, 0.0f), edge - glm::vec2(1.5f, 0.0f));
    CHECK(mouse.probe(0) == Probe{{16, 5}, {9, 9}});
}

TEST_CASE("a drag sets the box between two pixels, whichever corners they are") {
    for (const auto& [from, to] : {std::pair(glm::ivec2(5, 7), glm::ivec2(20, 30)),
                                   {{20, 30}, {5, 7}},
                                   {{5, 30}, {20, 7}},
                                   {{20, 7}, {5, 30}}}) {
        Mouse mouse;
        mouse.drag(mouse.over(0, from), mouse.over(0, to));
        CHECK(mouse.probe(0) == Probe{{5, 7}, {16, 24}});
    }
}

TEST_CASE("the box that is dragged can be seen, and is no probe before the button goes up") {
    Mouse mouse;
    mouse.round(mouse.over(0, {5, 7}), true);
    CHECK(draggedProbe(mouse.pointer, kImage) == Probe{{1, 3}, {9, 9}}); // if it becomes a click
    mouse.round(mouse.over(0, {9, 8}));
    CHECK(draggedProbe(mouse.pointer, kImage) == Probe{{5, 7}, {5, 2}});
    CHECK(mouse.probes() == 0);
    mouse.round(mouse.over(0, {9, 8}), false, true);
    CHECK(mouse.probes() == 1);
    CHECK_FALSE(draggedProbe(mouse.pointer, kImage));
}

TEST_CASE("a drag out of the picture reaches its edge, over a panel and another pane, too") {
    for (const PaneLayout layout : {PaneLayout::Single, PaneLayout::TwoUp, PaneLayout::FourUp})
        for (const bool overPanel : {false, true}) {
            CAPTURE(nameOf(layout));
            Mouse mouse(layout);
            mouse.round(mouse.over(0, {30, 20}), true);
            mouse.overPanel = overPanel;
            mouse.round({9e4f, 9e4f});
            mouse.round({9e4f, 9e4f}, false, true);
            CHECK(mouse.probe(0) == Probe{{30, 20}, {31, 17}});
            mouse.overPanel = false;
            mouse.round(mouse.over(0, {30, 20}), true);
            mouse.overPanel = overPanel;
            mouse.round({-9e4f, -9e4f}, false, true);
            CHECK(mouse.probe(0) == Probe{{0, 0}, {31, 21}});
            CHECK(mouse.state.panes.active == 0);
        }
}

TEST_CASE("with Shift each click adds a probe, while there is room; without, the active one goes") {
    Mouse mouse;
    mouse.shift = true;
    for (std::size_t i = 0; i < kProbes; ++i) {
        mouse.click(mouse.over(0, {10 + int(i), 13}));
        CHECK(mouse.probes() == i + 1);
        CHECK(mouse.state.activeProbe == i);
    }
    mouse.click(mouse.over(0, {40, 3}));
    CHECK(mouse.probes() == kProbes);
    for (std::size_t i = 0; i < kProbes; ++i)
        CHECK(mouse.probe(i).min.x == (i + 1 < kProbes ? 6 + int(i) : 36));
    mouse.shift = false;
    mouse.state.activeProbe = 1;
    mouse.click(mouse.over(0, {50, 3}));
    CHECK(mouse.probe(1).min.x == 46);
    CHECK(mouse.probe(0).min.x == 6);
    mouse.state.probes[2].reset(); // the one that is free is taken
    mouse.shift = true;
    mouse.click(mouse.over(0, {55, 3}));
    CHECK(mouse.probe(2).min.x == 51);
}

TEST_CASE("dragging the divider moves it, sets no probe and chooses no pane") {
    Mouse mouse(PaneLayout::Wipe);
    const Rect picture = mouse.places()[0].picture;
    const float y = float(picture.min.y) + 20.0f;
    const auto at = [&](float part) {
        return glm::vec2(float(picture.min.x) + part * float(picture.size.x), y);
    };
    for (const float part : {0.8f, 0.1f, 0.5f}) {
        const float before = mouse.state.panes.divider;
        mouse.drag(at(before) + glm::vec2(3.0f, 0.0f), at(part));
        CHECK(mouse.state.panes.divider == doctest::Approx(part));
    }
    mouse.round(at(0.5f), true);
    mouse.overPanel = true;
    mouse.round({-1e4f, -50.0f});
    CHECK(mouse.state.panes.divider == 0.0f);
    mouse.round({-1e4f, -50.0f}, false, true);
    mouse.overPanel = false;
    mouse.round(at(0.7f)); // the button is up
    CHECK(mouse.state.panes.divider == 0.0f);
    CHECK(mouse.probes() == 0);
    CHECK(mouse.state.panes.active == 0);

    mouse.state.panes.divider = 0.5f;
    mouse.click(at(0.75f));
    CHECK(mouse.probes() == 1);
    CHECK(mouse.state.panes.active == 1);
    CHECK(mouse.state.panes.divider == 0.5f);
}

TEST_CASE("over a panel, beside the picture and before the first picture nothing happens") {
    Mouse mouse(PaneLayout::TwoUp);
    mouse.overPanel = true;
    mouse.drag(mouse.over(1, {5, 5}), mouse.over(1, {9, 9}));
    CHECK_FALSE(mouse.state.hovered);
    mouse.overPanel = false;
    mouse.drag({1.0f, 1.0f}, mouse.over(1, {9, 9})); // from outside the view
    const PanePlace place = mouse.places()[1];
    REQUIRE(place.cell.min.y < place.picture.min.y);
    mouse.click({float(place.picture.min.x) + 9.0f, float(place.cell.min.y) + 0.5f});
    CHECK_FALSE(mouse.state.hovered);
    mouse.image = {0, 0};
    mouse.click(mouse.over(1, {5, 5}));
    CHECK_FALSE(mouse.state.hovered);
    CHECK(mouse.probes() == 0);
    CHECK(mouse.state.panes.active == 0);
    CHECK_FALSE(mouse.state.showCurves);
}

TEST_CASE("what is under the mouse is known in every round") {
    Mouse mouse(PaneLayout::FourUp);
    mouse.round(mouse.over(2, {33, 12}));
    REQUIRE(mouse.state.hovered);
    CHECK(mouse.state.hovered->pane == 2);
    CHECK(mouse.state.hovered->pixel == glm::ivec2(33, 12));
    mouse.round({0.0f, 0.0f});
    CHECK_FALSE(mouse.state.hovered);
}

TEST_CASE("a probe at the mouse is the active one, around the pixel under it") {
    Mouse mouse;
    mouse.state.activeProbe = 2;
    probeAtMouse(mouse.state, kImage);
    CHECK(mouse.probes() == 0);
    mouse.round(mouse.over(0, {33, 12}));
    probeAtMouse(mouse.state, {0, 0});
    CHECK(mouse.probes() == 0);
    probeAtMouse(mouse.state, kImage);
    CHECK(mouse.probe(2) == Probe{{29, 8}, {9, 9}});
}

TEST_CASE("a box whose pane goes out of view while it is dragged stays as it was") {
    Mouse mouse(PaneLayout::FourUp);
    mouse.round(mouse.over(3, {5, 7}), true);
    mouse.round(mouse.over(3, {9, 8}));
    press(mouse.state, 'T'); // the difference of the first two
    press(mouse.state, 'T'); // one alone
    choosePane(mouse.state.panes, 0);
    mouse.round({1e3f, 1e3f}, false, true);
    CHECK(mouse.probe(0) == Probe{{5, 7}, {5, 2}});
}
