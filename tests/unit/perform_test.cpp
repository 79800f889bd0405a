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
    Texts different; ///< of factsOf(), and nothing else
    void (*prepare)(ViewState&) = [](ViewState&) {};
};

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
    return {
        {plain('F'), {"pane 0 filter=clamp"}},
        {shift('F'), {"pane 0 filter=svgf"}},
        {plain('H'), {"reset wanted=true"}},
        {plain('T'), {"layout=wipe"}},
        {shift('T'), {"layout=difference"}},
        {plain('G'), {"active=1"}},
        {shift('G'), {"active=1"}, wipe},
        {plain('X'), {"pair=1 0"}, wipe},
        {{Key::Left}, {"divider=0.48"}, wipe},
        {{Key::Right}, {"divider=0.52"}, wipe},
        {{Key::F7}, {"presets=true"}},
        {{keyOf('C'), true, true}, {"wants copied preset=true"}},
        {{keyOf('V'), true, true}, {"wants pasted preset=true"}},
    };
}

std::vector<Row> lightRows() {
    const auto exposed = [](const std::string& stops) {
        Texts all;
        for (const char pane : {'0', '1', '2', '3'})
            all.push_back(std::string("pane ") + pane + " exposure=" + stops + " stops");
        return all;
    };
    return {
        {plain('1'), {"light 0=false 1 1 1 1", "notice=Light key off"}},
        {plain('2'), {"light 1=false 1 1 1 1", "notice=Light fill off", "repeated=toggle fill"}},
        {shift('2'), {"light 1=true 0.5 1 1 1", "repeated=dim fill"}},
        {control('2'),
         {"light 1=true 1 1 1 1", "repeated=recolor fill"},
         [](ViewState& state) {
             state.lights[1].tint = {0.5f, 1.0f, 2.0f};
         }},
        {plain('3'), {}},
        {plain('L'), {"light 0=false 1 1 1 1", "notice=Light key off"}},
        {plain(']'), exposed("0.5")},
        {plain('['), exposed("-0.5")},
    };
}

std::vector<Row> timeRows() {
    return {
        {plain('P'), {"paused=true"}},
        {{Key::Space}, {"frozen=false", "paused=false", "shown=0 0"}, freeze},
        {plain('N'), {"paused=true", "steps left=1"}},
        {plain('N'), {"frozen=false", "shown=0 0", "steps left=1"}, freeze},
        {plain('.'), {"wants pass=1"}},
        {plain(','), {"wants pass=-1"}},
        {plain('K'), {"frame limit=30"}},
        {shift('K'), {"frame limit=5"}, [](ViewState& s) { s.time.frameLimit = 2; }},
        {plain('I'), {"checkpoint wanted=true", "checkpoint=true", "recording=0"}},
        {plain('O'), {}},
        {plain('O'),
         {"frame=3", "playing=take-1 3 2 0 true", "recorded=take-1 3 2", "recording=none",
          "restore wanted=true", "seconds=0.05", "takes=1"},
         record},
        {shift('O'), {}},
        {shift('O'),
         {"frame=3", "playing=take-1 3 2 0 true", "restore wanted=true", "seconds=0.05"},
         leaveLoop},
        {{Key::Backspace}, {"playing=none"}, loop},
        {control('T'), {"wants saved take=true"}},
        {plain('Y'), {"notice=toggle key every 60 frames", "repeat=60"}},
        {plain('Y'),
         {"notice=Nothing repeats", "repeat=0"},
         [](ViewState& state) { startRepeat(state.time, 7); }},
        {plain('M'),
         {"animate=false", "marks=movement stops", "notice=Nothing moves in this scene",
          "repeated=start or stop what moves"}},
    };
}

std::vector<Row> cameraRows() {
    const Texts home{"camera=home", "cut pending=true"};
    return {
        {plain('R'), home, remember},
        {{Key::Home}, home, remember},
        {plain('C'), {"camera=elsewhere", "cut pending=true", "repeated=camera cut"}},
        {shift('C'), {"marks=camera starts", "on path=true", "repeated=camera path"}},
        {control('B'), {"bookmarks=1", "notice=Remembered as place 1: Ctrl Shift 1"}},
        {{keyOf('1'), true, true}, {"camera=place 1", "cut pending=true"}, remember},
        {{keyOf('2'), true, true}, {}, remember},
    };
}

std::vector<Row> viewRows() {
    const auto half = [](ViewState& state) { state.resolution.scale = 0.5f; };
    return {
        {plain('V'), {"shown=color"}},
        {shift('V'), {"shown=0 0"}, [](ViewState& s) { cycleImage(s, 1); }},
        {plain('B'), {"shown=0 0"}, [](ViewState& s) { cycleImage(s, 2); }},
        {plain('='), {"resolution=true 0.75 640 360"}, half},
        {plain('-'), {"resolution=true 0.25 640 360"}, half},
        {plain('U'), {"frozen=true", "paused=true", "shown=error"}},
        {plain('U'), {"frozen=false", "paused=false", "shown=0 0"}, freeze},
        {shift('U'), {"frozen=true", "paused=true", "shown=error"}},
        {shift('U'), {"shown=reference"}, freeze},
    };
}

std::vector<Row> measureRows() {
    return {
        {plain('J'), {"wants probe=true"}, hover},
        {plain('J'), {"error=true", "notice=The mouse is not over a picture"}},
        {shift('J'),
         {"active probe=0", "probe 2=none"},
         [](ViewState& state) {
             setProbe(state, 2, {{1, 2}, {3, 4}}, {61, 37});
         }},
        {plain('Z'), {"curve=" + std::string(quantities()[1].name), "curves=true"}},
        {control('C'), {"wants copied curves=true"}},
        {control('E'), {"wants saved curves=true"}},
        {control('I'), {"inspected=0 3 4", "inspector=true"}, hover},
        {control('I'),
         {"inspected=none"},
         [](ViewState& state) {
             hover(state);
             press(state, control('I'));
             state.hovered->pixel.x = 9;
         }},
    };
}

std::vector<Row> windowRows() {
    const auto touring = [](ViewState& state) { state.tourStop = 2; };
    return {
        {{Key::F12}, {"wants picture=true"}},
        {control('S'), {"wants picture=true"}},
        {{.key = Key::F12, .shift = true}, {"wants window=true"}},
        {{.key = Key::F12, .control = true}, {"wants image files=true"}},
        {{Key::F9}, {"wants record=true"}},
        {{Key::F5}, {"wants shaders=true"}},
        {{Key::Tab}, {"panel=false"}},
        {{Key::F2}, {"inspector=true"}},
        {{Key::F3}, {"passes=true"}},
        {{Key::F4}, {"curves=true"}},
        {{Key::F8}, {"strip=false"}},
        {{Key::F6}, {"wants stop=0"}},
        {{Key::F6}, {"tour stop=none"}, touring},
        {{Key::PageDown}, {"wants stop=0"}},
        {{Key::PageDown}, {"wants stop=3"}, touring},
        {{Key::PageUp}, {"wants stop=1"}, touring},
        {{Key::PageUp}, {}},
        {{Key::PageUp}, {}, [](ViewState& state) { state.tourStop = 0; }},
        {{Key::F11}, {"vsync=false"}},
        {{Key::F10}, {"keyboard in panel=true"}},
        {{Key::F1}, {"help=true"}},
        {{Key::Escape}, {"help=false"}, [](ViewState& state) { state.showHelp = true; }},
        {control('Q'), {"quit=true"}},
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
        REQUIRE(actionOf(row.stroke));
        ViewState state = cornellState();
        renderFrames(state, 3);
        row.prepare(state);
        const Facts before = factsOf(state);
        press(state, row.stroke);
        Texts expected = row.different;
        std::ranges::sort(expected);
        Texts different = differences(before, factsOf(state));
        std::ranges::sort(different);
        CHECK(different == expected);
    }
}

TEST_CASE("every action changes something, and is among those that are tested") {
    std::set<const Action*> changing;
    for (const Row& row : allRows())
        if (!row.different.empty())
            changing.insert(actionOf(row.stroke));
    // Of a row of digits one stands for all.
    for (const KeyGroup& group : keyGroups())
        for (const KeyRow& row : group.rows) {
            CAPTURE(row.keys);
            std::size_t count = 0;
            for (const Action& action : row.actions)
                count += changing.contains(&action);
            CHECK(count >= (row.actions.size() == 9 ? 1 : row.actions.size()));
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
