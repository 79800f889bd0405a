// SPDX-License-Identifier: MIT
#include "app/workbench/camera_flight.h"
#include "window_hands.h"

#include <set>

using namespace afterglow;

// What the person's hands make of the next frame: liveFrame() and what surrounds it.

namespace {

using Texts = std::vector<std::string>;

/// A window in which some frames have been rendered.
ViewState running(std::string_view scene = "cornell") {
    ViewState state = stateOf(scene);
    renderFrames(state, 3);
    return state;
}

Take takeOfTwo(const ViewState& state, std::size_t lights) {
    Take take{.name = "two"};
    for (int i = 0; i < 2; ++i) {
        SceneFrame given{
            .frame = 100u + std::uint32_t(i), .seconds = i / 60.0, .camera = state.home};
        given.camera.position.x += 0.1f * float(i + 1);
        given.lights.resize(lights);
        if (lights > 0)
            given.lights[0].power = 0.25f * float(i + 1);
        take.frames.push_back(given);
    }
    return take;
}

} // namespace

TEST_CASE("a frame in which nothing happens has no marks, the very first one included") {
    ViewState state = cornellState();
    for (int i = 0; i < 3; ++i) {
        const SceneFrame given = renderFrame(state);
        CHECK(given.marks.empty());
        CHECK_FALSE(given.step);
        CHECK(given.camera == state.home);
        CHECK(given.lights == state.lights);
    }
}

TEST_CASE("a light that changes marks one frame, which is a step") {
    for (const auto& [stroke, mark] : {std::pair(KeyStroke{keyOf('1')}, "key off"),
                                       {{.key = keyOf('2'), .shift = true}, "fill to 50 %"},
                                       {{.key = keyOf('1'), .control = true}, "key tinted"}}) {
        ViewState state = running();
        press(state, stroke);
        const SceneFrame given = renderFrame(state);
        CHECK(given.marks == Texts{mark});
        CHECK(given.step);
        CHECK(state.time.past.back().marks == given.marks);
        CHECK(renderFrame(state).marks.empty());
    }
}

TEST_CASE("several lights in one frame are one step, and one that is back is none") {
    ViewState state = running();
    press(state, '1');
    press(state, '2');
    const SceneFrame both = renderFrame(state);
    CHECK(both.marks == Texts{"key off", "fill off"});
    CHECK(both.step);
    press(state, '1');
    press(state, '1');
    const SceneFrame none = renderFrame(state);
    CHECK(none.marks.empty());
    CHECK_FALSE(none.step);
}

TEST_CASE("a change of light is no step where the camera or the scene begins to move with it") {
    for (const KeyStroke stroke :
         {KeyStroke{keyOf('M')}, {keyOf('C')}, {.key = keyOf('C'), .shift = true}}) {
        ViewState state = running("moving");
        press(state, stroke);
        press(state, '1');
        const SceneFrame given = renderFrame(state);
        CHECK(given.marks.size() == 2);
        CHECK(given.marks.back() == "key off");
        CHECK_FALSE(given.step);
    }
    ViewState state = running(); // one that flies is not marked
    state.camera.position.x += 0.01f;
    press(state, '1');
    const SceneFrame given = renderFrame(state);
    CHECK(given.marks == Texts{"key off"});
    CHECK_FALSE(given.step);
    press(state, '1');
    CHECK(renderFrame(state).step);
}

TEST_CASE(
    "a change of light is no step while the scene moves by itself, and is one when it stands") {
    ViewState state = running("moving");
    press(state, '1');
    const SceneFrame moving = renderFrame(state);
    CHECK(moving.marks == Texts{"key off"});
    CHECK_FALSE(moving.step);
    press(state, 'M');
    renderFrames(state, 2);
    press(state, '1');
    CHECK(renderFrame(state).step);
}

TEST_CASE("a camera that jumps marks its frame, one that flies or stays does not") {
    ViewState state = running();
    press(state, {Key::Home}); // it is there
    CHECK(renderFrame(state).marks.empty());
    press(state, 'C');
    CHECK(renderFrame(state).marks == Texts{"camera cut"});
    CHECK(renderFrame(state).marks.empty());
    state.camera.position.x += 0.01f;
    CHECK(renderFrame(state).marks.empty());
    press(state, 'R');
    CHECK(renderFrame(state).marks == Texts{"camera cut"});
    press(state, {.key = keyOf('B'), .control = true});
    state.camera.position.x += 0.5f;
    CHECK(renderFrame(state).marks.empty());
    press(state, {.key = keyOf('1'), .control = true, .shift = true});
    CHECK(renderFrame(state).marks == Texts{"camera cut"});
}

TEST_CASE("movement and the camera's path are marked where they start and stop") {
    ViewState state = running("moving");
    for (const char* mark : {"movement stops", "movement starts"}) {
        press(state, 'M');
        CHECK(renderFrame(state).marks == Texts{mark});
        CHECK(renderFrame(state).marks.empty());
    }
    const KeyStroke path{.key = keyOf('C'), .shift = true};
    press(state, path);
    CHECK(renderFrame(state).marks == Texts{"camera starts"});
    const glm::vec3 before = state.camera.position;
    renderFrames(state, 30);
    CHECK(state.camera.position != before);
    press(state, path);
    const glm::vec3 there = state.camera.position;
    CHECK(renderFrame(state).marks == Texts{"camera stops"});
    renderFrames(state, 3);
    CHECK(state.camera.position == there);
}

TEST_CASE("the camera's path begins at home, or at the first of two bookmarks, and is steady") {
    for (const bool hasBookmarks : {false, true}) {
        ViewState state = running();
        Camera first = state.home;
        if (hasBookmarks) {
            state.camera.position.x += 0.1f;
            first = state.camera;
            addBookmark(state);
            state.camera.position.x -= 0.2f;
            addBookmark(state);
        }
        letHappen(state, {EventKind::CameraPath});
        renderFrame(state);
        CHECK(glm::distance(state.camera.position, first.position) < 1e-6f);
        glm::vec3 before = state.camera.position;
        const double round = (hasBookmarks ? 2 : 4) * kSecondsPerKey * kFixedRate;
        for (int frame = 1; frame <= int(round); ++frame) {
            renderFrame(state);
            REQUIRE(glm::distance(state.camera.position, before) < 0.01f * state.extent);
            before = state.camera.position;
            if (hasBookmarks && frame == int(kSecondsPerKey * kFixedRate))
                CHECK(glm::distance(before, bookmarks(state)[1].position) < 1e-4f);
        }
        CHECK(glm::distance(state.camera.position, first.position) < 1e-4f); // once around
    }
}

TEST_CASE("what repeats happens in the frames first, first + every, ... and in no other") {
    for (const int every : {1, 2, 7, 60}) {
        CAPTURE(every);
        ViewState state = running();
        press(state, '2');
        renderFrames(state, 5);
        state.repeatEvery = every;
        press(state, 'Y');
        const std::uint32_t first = state.time.frame;
        for (int i = 0; i < 4 * every + 1; ++i) {
            const std::uint32_t frame = state.time.frame;
            const bool before = state.lights[1].on;
            const SceneFrame given = renderFrame(state);
            const bool due = (frame - first) % std::uint32_t(every) == 0;
            CHECK(given.step == due);
            CHECK((given.lights[1].on != before) == due);
        }
        press(state, 'Y');
        for (int i = 0; i < 2 * every; ++i)
            CHECK(renderFrame(state).marks.empty());
    }
}

TEST_CASE("every kind of event can repeat") {
    for (std::size_t kind = 0; kind < kEventKinds; ++kind) {
        CAPTURE(kind);
        ViewState state = running("moving");
        letHappen(state, {EventKind(kind)});
        renderFrame(state);
        state.repeatEvery = 5;
        toggleRepeat(state);
        CHECK(state.notice.text == nameOf(state.repeated, state.lightNames) + " every 5 frames");
        for (int i = 0; i < 11; ++i)
            CHECK(renderFrame(state).marks.empty() == (i % 5 != 0));
    }
}

TEST_CASE("a frozen moment is held, and playing goes on after it") {
    for (const KeyStroke stroke : {KeyStroke{keyOf('U')}, {Key::Space}}) {
        ViewState state = running();
        press(state, 'U');
        CHECK(state.frozen);
        CHECK(state.shown == Shown{Shown::Kind::Image, aovs().size()});
        CHECK(images()[state.shown.index].name == "error");
        CHECK_FALSE(wantsFrame(state.time, 1e3));
        press(state, stroke);
        CHECK_FALSE(state.frozen);
        CHECK(state.shown == Shown{});
        CHECK(wantsFrame(state.time, 1e3));
    }
}

TEST_CASE("a step out of a frozen moment is one frame, and an image of the frame stays") {
    ViewState state = running();
    press(state, 'U');
    show(state, Shown::Kind::Image, 2);
    press(state, 'N');
    CHECK_FALSE(state.frozen);
    CHECK(state.shown == Shown{Shown::Kind::Image, 2});
    renderFrame(state);
    CHECK_FALSE(wantsFrame(state.time, 1e3));
}

TEST_CASE("a record that is replayed, and another scene, end a frozen moment") {
    ViewState state = running();
    press(state, 'I');
    renderFrames(state, 3);
    press(state, 'O');
    renderFrames(state, 1);
    press(state, 'U');
    press(state, {.key = keyOf('O'), .shift = true});
    CHECK_FALSE(state.frozen);
    CHECK(state.shown == Shown{});
    CHECK(wantsFrame(state.time, 1e3));

    press(state, 'U');
    enterScene(state, makeProceduralScene("moving"));
    CHECK_FALSE(state.frozen);
    CHECK(state.shown == Shown{});
    CHECK_FALSE(state.time.paused);
}

TEST_CASE("all views of the truth come around, and none is left when time goes on") {
    ViewState state = running();
    const KeyStroke next{.key = keyOf('U'), .shift = true};
    std::set<std::size_t> seen;
    for (std::size_t i = aovs().size(); i < images().size(); ++i) {
        press(state, next);
        CHECK(state.frozen);
        CHECK(state.shown.isTruth());
        seen.insert(state.shown.index);
    }
    CHECK(seen.size() == 6);
    press(state, next);
    CHECK(state.shown.index == aovs().size());
}

TEST_CASE("a take has its own camera and lights, and who leaves it goes on with them") {
    for (const std::size_t lights : {std::size_t(2), std::size_t(1), std::size_t(0)}) {
        CAPTURE(lights);
        ViewState state = running();
        press(state, {.key = keyOf('C'), .shift = true}); // on a path
        press(state, '2');
        renderFrames(state, 5);
        const Take take = takeOfTwo(state, lights);
        play(state.time, take, true);
        for (std::size_t i = 0; i < 2; ++i) {
            renderFrame(state);
            CHECK(state.camera == take.frames[i].camera);
            CHECK(state.lights[0] == (lights > 0 ? take.frames[i].lights[0] : LightState{}));
            CHECK(state.lights[1] == LightState{}); // what a take does not name is as in the scene
        }
        press(state, {Key::Backspace});
        CHECK_FALSE(state.time.playing);
        CHECK(state.camera == take.frames[1].camera);
        const SceneFrame given = renderFrame(state);
        CHECK(given.marks.empty());
        CHECK(given.camera == take.frames[1].camera);
    }
}

TEST_CASE("leaving no take changes nothing") {
    ViewState state = running();
    const Camera before = state.camera;
    press(state, '1');
    press(state, {Key::Backspace});
    CHECK(state.camera == before);
    CHECK_FALSE(state.lights[0].on);
    CHECK(renderFrame(state).marks == Texts{"key off"});
}
