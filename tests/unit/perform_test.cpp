// SPDX-License-Identifier: MIT
#include "state_facts.h"
#include "window_hands.h"

#include <algorithm>
#include <set>

using namespace afterglow;

// Every key is an action, and every action a function on plain values.

namespace {

using Texts = std::vector<std::string>;

struct Row {
    KeyStroke stroke;
    Action action;
    Texts different; ///< of factsOf(), and nothing else
    void (*prepare)(ViewState&) = [](ViewState&) {};
};

KeyStroke plain(char key) {
    return {keyOf(key)};
}
KeyStroke shift(char key) {
    return {.key = keyOf(key), .shift = true};
}
KeyStroke control(char key) {
    return {.key = keyOf(key), .control = true};
}

// What must have been done before. All begin in the Cornell box after three frames.
void hover(ViewState& state) {
    state.hovered = PanePixel{0, {3, 4}};
}
void wipe(ViewState& state) {
    chooseLayout(state.panes, PaneLayout::Wipe);
}
void record(ViewState& state) {
    markIn(state.time);
    renderFrames(state, 2);
}
void loop(ViewState& state) {
    record(state);
    markOut(state.time);
    renderFrame(state);
}
void leaveLoop(ViewState& state) {
    loop(state);
    stopTake(state);
}
void remember(ViewState& state) {
    state.camera.position.x += 0.01f;
    addBookmark(state);
    state.camera.position.x += 0.01f;
    state.notice = {};
}
void freeze(ViewState& state) {
    toggleFreeze(state);
}

std::vector<Row> filterRows() {
    using enum Action;
    return {
        {plain('F'), NextFilter, {"pane 0 filter=clamp"}},
        {shift('F'), PreviousFilter, {"pane 0 filter=svgf"}},
        {plain('H'), ResetHistory, {"reset wanted=true"}},
        {plain('T'), NextLayout, {"layout=wipe"}},
        {shift('T'), PreviousLayout, {"layout=difference"}},
        {plain('G'), NextPane, {"active=1"}},
        {shift('G'), PreviousPane, {"active=1"}, wipe},
        {plain('X'), SwapPair, {"pair=1 0"}, wipe},
        {{Key::Left}, DividerLeft, {"divider=0.48"}, wipe},
        {{Key::Right}, DividerRight, {"divider=0.52"}, wipe},
        {{Key::F7}, TogglePresets, {"presets=true"}},
        {{keyOf('C'), true, true}, CopyPreset, {"wants copied preset=true"}},
        {{keyOf('V'), true, true}, PastePreset, {"wants pasted preset=true"}},
    };
}

std::vector<Row> lightRows() {
    using enum Action;
    const auto exposed = [](const std::string& stops) {
        Texts all;
        for (const char pane : {'0', '1', '2', '3'})
            all.push_back(std::string("pane ") + pane + " exposure=" + stops + " stops");
        return all;
    };
    return {
        {plain('1'), ToggleLight, {"light 0=false 1 1 1 1", "notice=Light key off"}},
        {plain('2'),
         ToggleLight,
         {"light 1=false 1 1 1 1", "notice=Light fill off", "repeated=toggle fill"}},
        {shift('2'), DimLight, {"light 1=true 0.5 1 1 1", "repeated=dim fill"}},
        {control('2'),
         ColorLight,
         {"light 1=true 1 1 1 1", "repeated=recolor fill"},
         [](ViewState& state) {
             state.lights[1].tint = {0.5f, 1.0f, 2.0f};
         }},
        {plain('3'), ToggleLight, {}},
        {plain('L'), ToggleKeyLight, {"light 0=false 1 1 1 1", "notice=Light key off"}},
        {plain(']'), Brighter, exposed("0.5")},
        {plain('['), Darker, exposed("-0.5")},
    };
}

std::vector<Row> timeRows() {
    using enum Action;
    return {
        {plain('P'), TogglePause, {"paused=true"}},
        {{Key::Space}, TogglePause, {"frozen=false", "paused=false", "shown=0 0"}, freeze},
        {plain('N'), StepOnce, {"paused=true", "steps left=1"}},
        {plain('N'), StepOnce, {"frozen=false", "shown=0 0", "steps left=1"}, freeze},
        {plain('.'), NextPass, {"wants pass=1"}},
        {plain(','), PreviousPass, {"wants pass=-1"}},
        {plain('K'), Slower, {"frame limit=30"}},
        {shift('K'), Faster, {"frame limit=5"}, [](ViewState& s) { s.time.frameLimit = 2; }},
        {plain('I'), MarkIn, {"checkpoint wanted=true", "checkpoint=true", "recording=0"}},
        {plain('O'), MarkOut, {}},
        {plain('O'),
         MarkOut,
         {"frame=3", "playing=take-1 3 2 0 true", "recorded=take-1 3 2", "recording=none",
          "restore wanted=true", "seconds=0.05", "takes=1"},
         record},
        {shift('O'), Replay, {}},
        {shift('O'),
         Replay,
         {"frame=3", "playing=take-1 3 2 0 true", "restore wanted=true", "seconds=0.05"},
         leaveLoop},
        {{Key::Backspace}, StopTake, {"playing=none"}, loop},
        {control('T'), SaveTake, {"wants saved take=true"}},
        {plain('Y'), ToggleRepeat, {"notice=toggle key every 60 frames", "repeat=60"}},
        {plain('Y'),
         ToggleRepeat,
         {"notice=Nothing repeats", "repeat=0"},
         [](ViewState& state) { startRepeat(state.time, 7); }},
        {plain('M'),
         ToggleAnimation,
         {"animate=false", "marks=movement stops", "notice=Nothing moves in this scene",
          "repeated=start or stop what moves"}},
    };
}

std::vector<Row> cameraRows() {
    using enum Action;
    const Texts home{"camera=home", "cut pending=true"};
    return {
        {plain('R'), GoHome, home, remember},
        {{Key::Home}, GoHome, home, remember},
        {plain('C'), CutCamera, {"camera=elsewhere", "cut pending=true", "repeated=camera cut"}},
        {shift('C'),
         ToggleCameraPath,
         {"marks=camera starts", "on path=true", "repeated=camera path"}},
        {control('B'), AddBookmark, {"bookmarks=1", "notice=Remembered as place 1: Ctrl Shift 1"}},
        {{keyOf('1'), true, true}, GoToBookmark, {"camera=place 1", "cut pending=true"}, remember},
        {{keyOf('2'), true, true}, GoToBookmark, {}, remember},
    };
}

std::vector<Row> viewRows() {
    using enum Action;
    const auto half = [](ViewState& state) { state.resolution.scale = 0.5f; };
    return {
        {plain('V'), NextImage, {"shown=color"}},
        {shift('V'), PreviousImage, {"shown=0 0"}, [](ViewState& s) { cycleImage(s, 1); }},
        {plain('B'), ShowPicture, {"shown=0 0"}, [](ViewState& s) { cycleImage(s, 2); }},
        {plain('='), FinerPixels, {"resolution=true 0.75 640 360"}, half},
        {plain('-'), CoarserPixels, {"resolution=true 0.25 640 360"}, half},
        {plain('U'), Freeze, {"frozen=true", "paused=true", "shown=error"}},
        {plain('U'), Freeze, {"frozen=false", "paused=false", "shown=0 0"}, freeze},
        {shift('U'), NextOracle, {"frozen=true", "paused=true", "shown=error"}},
        {shift('U'), NextOracle, {"shown=reference"}, freeze},
    };
}

std::vector<Row> measureRows() {
    using enum Action;
    return {
        {plain('J'), ProbeHere, {"wants probe=true"}, hover},
        {plain('J'), ProbeHere, {"error=true", "notice=The mouse is not over a picture"}},
        {shift('J'),
         ClearProbes,
         {"active probe=0", "probe 2=none"},
         [](ViewState& state) {
             setProbe(state, 2, {{1, 2}, {3, 4}}, {61, 37});
         }},
        {plain('Z'), NextCurve, {"curve=" + std::string(quantities()[1].name), "curves=true"}},
        {control('C'), CopyCurves, {"wants copied curves=true"}},
        {control('E'), SaveCurves, {"wants saved curves=true"}},
        {control('I'), PinInspector, {"inspected=0 3 4", "inspector=true"}, hover},
        {control('I'),
         PinInspector,
         {"inspected=none"},
         [](ViewState& state) {
             hover(state);
             perform(state, {PinInspector});
             state.hovered->pixel.x = 9;
         }},
    };
}

std::vector<Row> windowRows() {
    using enum Action;
    const auto touring = [](ViewState& state) { state.tourStop = 2; };
    return {
        {{Key::F12}, SavePicture, {"wants picture=true"}},
        {control('S'), SavePicture, {"wants picture=true"}},
        {{.key = Key::F12, .shift = true}, SaveWindow, {"wants window=true"}},
        {{.key = Key::F12, .control = true}, SaveImageFiles, {"wants image files=true"}},
        {{Key::F9}, RecordFrames, {"wants record=true"}},
        {{Key::F5}, ReloadShaders, {"wants shaders=true"}},
        {{Key::Tab}, TogglePanel, {"panel=false"}},
        {{Key::F2}, ToggleInspector, {"inspector=true"}},
        {{Key::F3}, TogglePasses, {"passes=true"}},
        {{Key::F4}, ToggleCurves, {"curves=true"}},
        {{Key::F8}, ToggleStrip, {"strip=false"}},
        {{Key::F6}, ToggleTour, {"wants stop=0"}},
        {{Key::F6}, ToggleTour, {"tour stop=none"}, touring},
        {{Key::PageDown}, NextStop, {"wants stop=0"}},
        {{Key::PageDown}, NextStop, {"wants stop=3"}, touring},
        {{Key::PageUp}, PreviousStop, {"wants stop=1"}, touring},
        {{Key::PageUp}, PreviousStop, {}},
        {{Key::PageUp}, PreviousStop, {}, [](ViewState& state) { state.tourStop = 0; }},
        {{Key::F11}, ToggleVsync, {"vsync=false"}},
        {{Key::F10}, FocusPanel, {"keyboard in panel=true"}},
        {{Key::F1}, ToggleHelp, {"help=true"}},
        {{Key::Escape}, Dismiss, {"help=false"}, [](ViewState& state) { state.showHelp = true; }},
        {control('Q'), Quit, {"quit=true"}},
    };
}

std::vector<Row> allRows() {
    std::vector<Row> all;
    for (const auto& rows : {filterRows(), lightRows(), timeRows(), cameraRows(), viewRows(),
                             measureRows(), windowRows()})
        all.insert(all.end(), rows.begin(), rows.end());
    return all;
}

} // namespace

TEST_CASE("every key changes what it is said to change and nothing else") {
    for (const Row& row : allRows()) {
        CAPTURE(char(row.stroke.key));
        CAPTURE(row.stroke.control);
        CAPTURE(row.stroke.shift);
        const auto command = commandFor(row.stroke);
        REQUIRE(command);
        CHECK(command->action == row.action);
        ViewState state = cornellState();
        renderFrames(state, 3);
        row.prepare(state);
        const Facts before = factsOf(state);
        perform(state, *command);
        Texts expected = row.different;
        std::ranges::sort(expected);
        Texts different = differences(before, factsOf(state));
        std::ranges::sort(different);
        CHECK(different == expected);
    }
}

TEST_CASE("every action changes something, and is among those that are tested") {
    std::set<Action> changing;
    for (const Row& row : allRows())
        if (!row.different.empty())
            changing.insert(row.action);
    for (int action = 0; action <= int(Action::Quit); ++action) {
        CAPTURE(action);
        CHECK(changing.contains(Action(action)));
    }
}

TEST_CASE("what is switched by a key is as before when it is switched again") {
    for (const KeyStroke stroke : {plain('1'),
                                   shift('2'),
                                   control('2'),
                                   plain('L'),
                                   plain('P'),
                                   plain('U'),
                                   plain('X'),
                                   KeyStroke{Key::Tab},
                                   {Key::F1},
                                   {Key::F2},
                                   {Key::F3},
                                   {Key::F4},
                                   {Key::F7},
                                   {Key::F8},
                                   {Key::F10},
                                   {Key::F11}}) {
        CAPTURE(char(stroke.key));
        ViewState state = cornellState();
        renderFrames(state, 3);
        Facts before = factsOf(state);
        press(state, stroke);
        CHECK_FALSE(differences(before, factsOf(state)).empty());
        press(state, stroke);
        Facts after = factsOf(state);
        for (Facts* facts : {&before, &after})
            for (const char* told : {"notice", "repeated"})
                facts->erase(told);
        CHECK(differences(before, after).empty());
    }
}

TEST_CASE("Escape closes what is open, the innermost first, and then the inspected pixel") {
    ViewState state = cornellState();
    state.keyboardInPanel = state.showHelp = state.showPresets = true;
    state.tourStop = 1;
    state.inspected = PanePixel{0, {1, 1}};
    for (const char* closed : {"keyboard in panel=false", "help=false", "tour stop=none",
                               "presets=false", "inspected=none"}) {
        const Facts before = factsOf(state);
        press(state, {Key::Escape});
        CHECK(differences(before, factsOf(state)) == Texts{closed});
    }
    const Facts before = factsOf(state);
    press(state, {Key::Escape});
    CHECK(differences(before, factsOf(state)).empty());
}
