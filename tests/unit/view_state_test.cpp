// SPDX-License-Identifier: MIT
#include "renderer/base/error.h"
#include "tests/support/temporary_folder.h"
#include "window_hands.h"

#include <algorithm>
#include <fstream>
#include <set>

using namespace afterglow;

TEST_CASE("cycling through the filters comes back to the first, in both directions") {
    ViewState state = cornellState();
    const Filter first = state.settings().filter;
    for (const bool backward : {false, true}) {
        CAPTURE(backward);
        std::set<Filter> seen;
        for (std::size_t i = 0; i < allFilters().size(); ++i) {
            seen.insert(state.settings().filter);
            press(state, {.key = keyOf('F'), .shift = backward});
        }
        CHECK(seen.size() == allFilters().size());
        CHECK(state.settings().filter == first);
    }
    CHECK_FALSE(state.time.resetWanted); // another filter is no reason to forget
}

TEST_CASE("a filter is chosen for the active pane alone") {
    ViewState state = cornellState();
    const Panes before = state.panes;
    choosePane(state.panes, 2);
    chooseFilter(state, Filter::Confidence);
    CHECK(changedPanes(before, state.panes) == std::vector<std::size_t>{2});
    CHECK(state.settings().filter == Filter::Confidence);
}

TEST_CASE("number keys switch lights by slot, L the key light, and an empty slot does nothing") {
    ViewState state = cornellState();
    REQUIRE(state.lightNames == std::vector<std::string>{"key", "fill"});
    press(state, '2');
    CHECK(state.lights[0].on);
    CHECK_FALSE(state.lights[1].on);
    CHECK(state.notice.text == "Light fill off");
    press(state, '2');
    CHECK(state.lights[1].on);
    press(state, 'L');
    CHECK_FALSE(state.lights[0].on);
    const auto before = state.lights;
    press(state, '9');
    CHECK(state.lights == before);

    std::swap(state.lightNames[0], state.lightNames[1]);
    press(state, 'L');
    CHECK_FALSE(state.lights[1].on);
}

TEST_CASE(
    "going through the images shows all that the filter makes and no other, then the picture") {
    for (const Filter filter : allFilters()) {
        CAPTURE(nameOf(filter));
        ViewState state = cornellState();
        chooseFilter(state, filter);
        std::size_t made = 0;
        for (const AovInfo& aov : aovs())
            made += isMadeBy(aov, FilterSettings{filter, state.settings().denoiser});
        std::set<std::size_t> seen;
        for (std::size_t i = 0; i < made; ++i) {
            cycleImage(state, 1);
            REQUIRE(state.shown.kind == Shown::Kind::Image);
            CHECK(shownAov(state, 0) == state.shown.index);
            seen.insert(state.shown.index);
        }
        CHECK(seen.size() == made);
        cycleImage(state, 1);
        CHECK(state.shown == Shown{});
        cycleImage(state, -1);
        CHECK(state.shown.kind == Shown::Kind::Image);
    }
}

TEST_CASE("an image that a pane's filter does not make is its picture, until the filter makes it") {
    ViewState state = cornellState();
    while (state.shown.kind != Shown::Kind::Image || images()[state.shown.index].name != "lambda")
        cycleImage(state, 1);
    CHECK(shownAov(state, 0));
    CHECK_FALSE(shownAov(state, 1)); // SVGF
    chooseFilter(state, Filter::None);
    CHECK_FALSE(shownAov(state, 0));
    chooseFilter(state, Filter::Asvgf);
    CHECK(shownAov(state, 0));
    show(state, Shown::Kind::Pass, state.shown.index);
    CHECK_FALSE(shownAov(state, 0));
}

TEST_CASE("every field can be set, keeps to its range, and goes back to its default") {
    Settings settings;
    for (const Field& field : fields()) {
        CAPTURE(field.key);
        CHECK(&fieldByKey(field.key) == &field);
        CHECK(isDefault(settings, field));
        setFieldValue(settings, settings, field, field.max + 1e6);
        CHECK(fieldValue(settings, field) == doctest::Approx(field.max));
        setFieldValue(settings, settings, field, field.min - 1e6);
        CHECK(fieldValue(settings, field) == doctest::Approx(field.min));
        CHECK_FALSE((isDefault(settings, field) && field.min != fieldValue(Settings{}, field)));
        setFieldValue(settings, settings, field, fieldValue(Settings{}, field));
        CHECK(isDefault(settings, field));
    }
    CHECK_THROWS_AS(fieldByKey("alfa"), std::logic_error);
}

TEST_CASE("a value is told with its unit, or by the name of the choice") {
    CHECK(valueText(fieldByKey("alpha"), 0.2) == "0.2");
    CHECK(valueText(fieldByKey("exposure"), -1.5) == "-1.5 stops");
    for (const Field& field : fields())
        for (std::size_t i = 0; i < field.choices.size(); ++i)
            CHECK(valueText(field, double(i)) == field.choices[i]);
}

TEST_CASE("exposure goes in half stops, for all panes, to the ends of its range") {
    ViewState state = cornellState();
    press(state, ']');
    CHECK(state.panes.frame.display.exposure == 0.5f);
    const Field& field = fieldByKey("exposure");
    for (int i = 0; i < 100; ++i)
        press(state, ']');
    CHECK(double(state.panes.frame.display.exposure) == doctest::Approx(field.max));
    for (int i = 0; i < 100; ++i)
        press(state, '[');
    CHECK(double(state.panes.frame.display.exposure) == doctest::Approx(field.min));
}

TEST_CASE("all quantities of the curves come around") {
    ViewState state = cornellState();
    std::set<ProbeQuantity> seen;
    for (std::size_t i = 0; i < quantities().size(); ++i) {
        press(state, 'Z');
        seen.insert(state.curve);
    }
    CHECK(seen.size() == quantities().size());
    CHECK(state.curve == ProbeQuantity::Lit);
}

TEST_CASE("home is the scene's camera, wherever one flew") {
    ViewState state = cornellState();
    const Camera home = state.camera;
    fly(state.camera, {.move = {1, 1, 1}, .look = {1, 1}}, 3.0f, 1.0);
    REQUIRE_FALSE(state.camera == home);
    press(state, {Key::Home});
    CHECK(state.camera == home);
}

TEST_CASE("an unknown camera is named together with the known ones") {
    const Scene scene = makeProceduralScene("cornell");
    try {
        startState(scene, Settings{}, "nowhere");
        FAIL("it was accepted");
    } catch (const UsageError& error) {
        CHECK(std::string(error.what()).find("nowhere") != std::string::npos);
        CHECK(std::string(error.what()).find(scene.cameras.front().name) != std::string::npos);
    }
    CHECK_NOTHROW(startState(scene, Settings{}, scene.cameras.front().name));
}

TEST_CASE("camera cuts go from place to place and around, and always to another one") {
    for (const std::size_t places : {0u, 1u, 2u, 5u}) {
        CAPTURE(places);
        ViewState state = cornellState();
        for (std::size_t i = 0; i < places; ++i) {
            state.camera.position.x += 0.05f;
            addBookmark(state);
        }
        goHome(state);
        std::vector<Camera> seen;
        for (int i = 0; i < 12; ++i) {
            const Camera before = state.camera;
            press(state, 'C');
            CHECK_FALSE(state.camera == before);
            if (std::ranges::none_of(seen, [&](const Camera& c) { return c == state.camera; }))
                seen.push_back(state.camera);
        }
        CHECK(seen.size() == (places == 0 ? 4 : std::max<std::size_t>(places, 2)));
        if (places >= 2)
            CHECK(seen.front().position == bookmarks(state).front().position);
    }
}

TEST_CASE("nine places are remembered by scene, each with a name of its own, and gone to") {
    ViewState state = cornellState();
    std::set<std::string> names;
    std::vector<Camera> cameras;
    for (std::size_t i = 0; i < kBookmarks; ++i) {
        state.camera.position.y += 0.01f;
        state.camera.lens.verticalFov = 0.5f + 0.01f * float(i);
        cameras.push_back(state.camera);
        press(state, {.key = keyOf('B'), .control = true});
        CHECK_FALSE(state.notice.isError);
        if (i == 3) // a name that is free again is not given to two
            bookmarks(state).erase(bookmarks(state).begin() + 1);
        if (i == 3)
            cameras.erase(cameras.begin() + 1);
    }
    addBookmark(state);
    CHECK(bookmarks(state).size() == kBookmarks);
    CHECK_FALSE(state.notice.isError);
    addBookmark(state);
    CHECK(bookmarks(state).size() == kBookmarks);
    CHECK(state.notice.isError);
    for (const CameraBookmark& place : bookmarks(state))
        names.insert(place.name);
    CHECK(names.size() == kBookmarks);
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        state.onPath = true;
        press(state, {.key = keyOf(char('1' + i)), .control = true, .shift = true});
        CHECK(state.camera == cameras[i]);
        CHECK_FALSE(state.onPath);
    }
    state.sceneName = "elsewhere";
    CHECK(bookmarks(state).empty());
    const Camera before = state.camera;
    goToBookmark(state, 0);
    CHECK(state.camera == before);
}

TEST_CASE("in another scene lights, cameras, time and probes start over; panes and panels stay") {
    ViewState state = cornellState();
    press(state, 'T');
    press(state, {Key::F2});
    press(state, '1');
    setField(state.panes, fieldByKey("alpha"), 0.05);
    setProbe(state, 2, {{1, 2}, {3, 4}}, {61, 37});
    renderFrames(state, 5);
    state.hovered = state.inspected = PanePixel{1, {3, 3}};
    press(state, {.key = keyOf('C'), .shift = true});
    const Panes before = state.panes;
    enterScene(state, makeProceduralScene("rooms"));
    CHECK(state.lightNames == std::vector<std::string>{"key", "behind wall"});
    CHECK(state.lights == std::vector<LightState>(2));
    CHECK(state.lightColors.size() == 2);
    CHECK(state.time.frame == 0);
    CHECK(state.time.past.empty());
    CHECK(state.camera == state.home);
    CHECK_FALSE(state.onPath);
    CHECK(state.probes == ViewState{}.probes);
    CHECK_FALSE(state.hovered);
    CHECK_FALSE(state.inspected);
    CHECK(changedPanes(before, state.panes).empty());
    CHECK(state.panes.layout == PaneLayout::Wipe);
    CHECK(state.showInspector);
    CHECK(renderFrame(state).marks.empty());
}

TEST_CASE("what the person is told goes away by itself, an error later than the rest") {
    ViewState state = cornellState();
    for (const bool isError : {false, true}) {
        notify(state, "Something", isError);
        passTime(state, 4.9);
        CHECK(state.notice.secondsLeft > 0.0);
        passTime(state, 0.2);
        CHECK((state.notice.secondsLeft > 0.0) == isError);
        passTime(state, 100.0);
        CHECK(state.notice.secondsLeft == 0.0);
    }
}

TEST_CASE("a file that is saved never takes the name of one that is there") {
    const TemporaryFolder folder;
    const auto next = [&] { return freePath(folder.path(), "afterglow", ".png").filename(); };
    CHECK(next() == "afterglow-0001.png");
    std::ofstream(folder.path() / "afterglow-0001.png") << "mine";
    std::ofstream(folder.path() / "afterglow-0003.png") << "mine too";
    CHECK(next() == "afterglow-0002.png");
    CHECK(freePath(folder.path(), "curves", ".csv").filename() == "curves-0001.csv");
    CHECK(freePath(folder.path(), "afterglow", ".csv").filename() == "afterglow-0001.csv");
}
