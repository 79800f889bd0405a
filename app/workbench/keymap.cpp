// SPDX-License-Identifier: MIT
#include "app/workbench/keymap.h"

#include "app/workbench/view_state.h"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace afterglow {
namespace {

constexpr float kDividerStep = 0.02f;

/// Returns the state or the part of it that a function changes.
template <class Part, class State>
auto& partOf(State& state) {
    if constexpr (std::is_same_v<Part, Panes>)
        return state.panes;
    else if constexpr (std::is_same_v<Part, Transport>)
        return state.time;
    else if constexpr (std::is_same_v<Part, Preferences>)
        return state.preferences;
    else
        return state;
}

template <class Part, class... Arguments>
auto call(void (*function)(Part&, Arguments...), std::type_identity_t<Arguments>... arguments) {
    return [=](ViewState& state) { function(partOf<Part>(state), arguments...); };
}

auto ask(bool Requests::*request) {
    return [=](ViewState& state) { state.wanted.*request = true; };
}

/// An action that turns something on and off.
template <class Part>
Action flip(Key key, bool Part::*flag, const char* label = "", const char* tip = "") {
    return {.strokes = {{key}},
            .perform =
                [=](ViewState& state) {
                    bool& is = partOf<Part>(state).*flag;
                    is = !is;
                },
            .label = label,
            .tip = tip,
            .isLit = [=](const ViewState& state) { return partOf<Part>(state).*flag; }};
}

/// Actions of the number row with these modifiers, from 1 on.
std::vector<Action> numberRow(bool control, bool shift, void (*perform)(ViewState&, std::size_t)) {
    std::vector<Action> actions;
    for (std::size_t slot = 0; slot < 9; ++slot)
        actions.push_back({{{keyOf(char('1' + slot)), control, shift}}, call(perform, slot)});
    return actions;
}

auto happen(EventKind kind) {
    return [=](ViewState& state) { letHappen(state, {kind}); };
}
void dimLight(ViewState& state, std::size_t slot) {
    letHappen(state, {EventKind::Dim, slot});
}
void colorLight(ViewState& state, std::size_t slot) {
    letHappen(state, {EventKind::Recolor, slot});
}

// A frozen moment is let go by whatever lets time go on.
void thaw(ViewState& state) {
    if (state.frozen)
        toggleFreeze(state);
}

void pauseOrResume(ViewState& state) {
    if (!state.frozen)
        return togglePause(state.time);
    thaw(state);
    state.time.paused = false;
}

void step(ViewState& state) {
    thaw(state);
    stepOnce(state.time);
}

void replayTake(ViewState& state) {
    if (state.time.recorded)
        thaw(state);
    replay(state.time);
}

void changeResolution(ViewState& state, int step) {
    state.resolution = nextResolution(state.resolution, step);
}

void cycleOracle(ViewState& state) {
    if (!state.frozen)
        return toggleFreeze(state);
    const std::size_t first = aovs().size(), count = images().size() - first;
    const std::size_t next = state.shown.isTruth() ? state.shown.index + 1 - first : 0;
    show(state, Shown::Kind::Image, first + next % count);
}

void cycleCurve(ViewState& state) {
    state.showCurves = true;
    state.curve = ProbeQuantity((std::size_t(state.curve) + 1) % quantities().size());
}

// The program knows the size of the picture.
void probeHere(ViewState& state) {
    if (!state.hovered)
        return notify(state, "The mouse is not over a picture", true);
    state.wanted.probeAtMouse = true;
}

void pinInspector(ViewState& state) {
    state.showInspector = true;
    state.inspected = state.inspected ? std::nullopt : state.hovered;
}

// The innermost of what is open.
void dismiss(ViewState& state) {
    if (state.keyboardInPanel)
        state.keyboardInPanel = false;
    else if (state.showHelp)
        state.showHelp = false;
    else if (state.tourStop)
        state.tourStop.reset();
    else if (state.showPresets)
        state.showPresets = false;
    else
        state.inspected.reset();
}

void toggleTour(ViewState& state) {
    if (!std::exchange(state.tourStop, {}))
        state.wanted.tourStop = 0;
}

void focusPanel(ViewState& state) {
    state.keyboardInPanel = !state.keyboardInPanel && state.preferences.showPanel;
}

void nextStop(ViewState& state, int step) {
    const int next = state.tourStop ? int(*state.tourStop) + step : (step > 0 ? 0 : -1);
    if (next >= 0)
        state.wanted.tourStop = std::size_t(next);
}

using State = const ViewState&;

// clang-format off
std::vector<KeyGroup> allGroups() {
    return {
    {"Filter", {
        {"F, Shift F", "next, previous filter of the active pane",
         {{{plain('F')}, call(cycleFilter, 1)}, {{shift('F')}, call(cycleFilter, -1)}}},
        {"T, Shift T", "single, wipe, two up, four up, difference",
         {{{plain('T')}, call(cycleLayout, 1)}, {{shift('T')}, call(cycleLayout, -1)}}},
        {"G, Shift G", "next, previous pane",
         {{{plain('G')}, call(cyclePane, 1)}, {{shift('G')}, call(cyclePane, -1)}}},
        {"X", "swap the two panes", {{{plain('X')}, call(swapPair)}}},
        {"\xe2\x86\x90 \xe2\x86\x92", "move the divider of a wipe",
         {{{{Key::Left}}, call(moveDivider, -kDividerStep)},
          {{{Key::Right}}, call(moveDivider, kDividerStep)}}},
        {"H", "forget all history",
         {{{plain('H')}, [](ViewState& s) { s.time.resetWanted = true; }, "Forget all history",
           "The next frame starts from nothing, as after a cut. In all panes."}}},
        {"F7", "presets and lineages",
         {flip(Key::F7, &ViewState::showPresets, "Presets",
               "Filters with the parameters of papers and of other programs, and your own.")}},
        {"Ctrl Shift C, V", "copy, paste a preset",
         {{{{keyOf('C'), true, true}}, ask(&Requests::copyPreset), "Copy",
           "Copies the active pane as the text of a preset."},
          {{{keyOf('V'), true, true}}, ask(&Requests::pastePreset), "Paste",
           "Sets the active pane to the preset on the clipboard."}}}}},
    {"Light", {
        {"1 - 9", "switch a light on or off", numberRow(false, false, toggleLight)},
        {"Shift 1 - 9", "dim it to a half", numberRow(false, true, dimLight)},
        {"Ctrl 1 - 9", "another color, equal luminance", numberRow(true, false, colorLight)},
        {"L", "switch the key light", {{{plain('L')}, call(toggleKeyLight)}}},
        {"] [", "half a stop brighter, darker",
         {{{plain(']')}, call(changeExposure, 0.5f)}, {{plain('[')}, call(changeExposure, -0.5f)}}}}},
    {"Time", {
        {"P, Space", "pause or resume", {{{plain('P'), {Key::Space}}, pauseOrResume, "Pause",
           "While paused nothing is rendered: changes show with the next step."}}},
        {"N", "render one frame, then pause",
         {{{plain('N')}, step, "Step frame", "Renders one frame, then pauses."}}},
        {". ,", "next, previous pass of a frame",
         {{{plain('.')}, [](ViewState& s) { ++s.wanted.passStep; }, "Step pass",
           "Shows what the next pass of this frame made; the comma goes back."},
          {{plain(',')}, [](ViewState& s) { --s.wanted.passStep; }}}},
        {"K, Shift K", "slower, faster", {{{plain('K')}, call(slower)}, {{shift('K')}, call(faster)}}},
        {"I, O", "in point; out point: loop between them",
         {{{plain('I')}, call(markIn), "In",
           "From the next frame on frames are recorded, and their lights and camera with them.",
           [](State s) { return s.time.recording.has_value(); }, {}, true},
          {{plain('O')}, call(markOut), "Out",
           "Ends the recording and loops it, each round bit for bit like the one before.", {},
           [](State s) { return s.time.recording && !s.time.recording->frames.empty(); }}}},
        {"Shift O", "loop the last take again",
         {{{shift('O')}, replayTake, "Replay", "Loops the last take again.",
           [](State s) { return s.time.playing && s.time.playing->loops; },
           [](State s) { return s.time.recorded && !s.time.recording; }}}},
        {"Backspace", "leave the take",
         {{{{Key::Backspace}}, stopTake, "Leave",
           "Leaves the take: live play goes on from what is seen, with lights and camera yours again.",
           {}, [](State s) { return s.time.playing.has_value(); }}}},
        {"Ctrl T", "save the take as an experiment",
         {{{control('T')}, ask(&Requests::saveTake), "Save",
           "Writes the take as an experiment, which 'afterglow experiment' measures.",
           {}, [](State s) { return s.time.recorded.has_value(); }}}},
        {"Y", "repeat the last event, or stop that", {{{plain('Y')}, toggleRepeat}}},
        {"M", "play or stop the scene's movement",
         {{{plain('M')}, happen(EventKind::Animation), "Movement",
           "Plays the scene's own animation, if it has one.",
           [](State s) { return s.time.animate && s.isAnimated; },
           [](State s) { return s.isAnimated; }}}}}},
    {"Camera", {
        {"W A S D", "fly", {}},
        {"Q, E", "down, up", {}},
        {"Shift", "four times faster", {}},
        {"Right drag", "look around", {}},
        {"Wheel", "flying speed", {}},
        {"R, Home", "back to the scene's camera",
         {{{plain('R'), {Key::Home}}, goHome, "Back to the scene's camera"}}},
        {"C, Shift C", "camera cut; camera path",
         {{{plain('C')}, happen(EventKind::CameraCut), "Camera cut",
           "To the next of the remembered places, or to a view from the side."},
          {{shift('C')}, happen(EventKind::CameraPath), "Camera path",
           "The camera takes three seconds from one remembered place to the next, and back; with fewer "
           "than two it sways.",
           [](State s) { return s.onPath; }}}},
        {"Ctrl B", "remember this place",
         {{{control('B')}, addBookmark, "Remember this place",
           "Up to nine in each scene. Camera cuts and the camera path go through them."}}},
        {"Ctrl Shift 1 - 9", "go to a remembered place", numberRow(true, true, goToBookmark)}}},
    {"View", {
        {"V, Shift V", "next, previous image of the frame",
         {{{plain('V')}, call(cycleImage, 1)}, {{shift('V')}, call(cycleImage, -1)}}},
        {"B", "back to the picture",
         {{{plain('B')}, [](ViewState& s) { show(s, Shown::Kind::Picture); }}}},
        {"+ -", "render more, fewer pixels",
         {{{plain('='), shift('=')}, call(changeResolution, 1)},
          {{plain('-')}, call(changeResolution, -1)}}},
        {"U", "freeze: converge the truth", {{{plain('U')}, toggleFreeze}}},
        {"Shift U", "next view of the truth", {{{shift('U')}, cycleOracle}}}}},
    {"Measure", {
        {"Click, drag", "set a probe", {}},
        {"J, Shift J", "a probe at the mouse; no probes",
         {{{plain('J')}, probeHere}, {{shift('J')}, clearProbes, "Clear", "Removes all probes."}}},
        {"Z", "next quantity of the curves", {{{plain('Z')}, cycleCurve}}},
        {"Ctrl C, Ctrl E", "copy, save the curves as CSV",
         {{{control('C')}, ask(&Requests::copyCurves), "Copy",
           "Copies all curves as CSV, with settings, events and results."},
          {{control('E')}, ask(&Requests::saveCurves), "Save", "Saves all curves as a CSV file."}}},
        {"Ctrl I", "hold the inspector on this pixel", {{{control('I')}, pinInspector}}}}},
    {"Files", {
        {"F12, Ctrl S", "save the picture as PNG",
         {{{{Key::F12}, control('S')}, ask(&Requests::picture), "Save picture",
           "What the panes show, pixel for pixel, as PNG."}}},
        {"Shift F12", "save the whole window as PNG",
         {{{{.key = Key::F12, .shift = true}}, ask(&Requests::window), "Save window",
           "The whole window as PNG."}}},
        {"Ctrl F12", "save every image of the frame",
         {{{{.key = Key::F12, .control = true}}, ask(&Requests::imageFiles), "All images",
           "Every image of this frame of the active pane, as numbers."}}},
        {"F9", "record frames, or end that", {{{{Key::F9}}, ask(&Requests::record), "Record frames",
           "Writes every frame as PNG into a folder of its own, and a film of them where there is ffmpeg."}}},
        {"F5", "reload the shaders", {{{{Key::F5}}, ask(&Requests::reloadShaders)}}}}},
    {"Window", {
        {"Tab", "hide or show the panel", {flip(Key::Tab, &Preferences::showPanel)}},
        {"F10", "keyboard in the panel; Esc leaves it", {{{{Key::F10}}, focusPanel}}},
        {"F2, F3, F4", "inspector, passes, curves",
         {flip(Key::F2, &ViewState::showInspector, "Inspector", "All that is known of one pixel."),
          flip(Key::F3, &ViewState::showPasses, "Passes",
               "What each pass of a frame makes, and how long it takes."),
          flip(Key::F4, &ViewState::showCurves, "Curves", "What the probes read, frame by frame.")}},
        {"F8", "timeline",
         {flip(Key::F8, &ViewState::showStrip, "Timeline", "What happened in the last frames.")}},
        {"F6", "guided tour",
         {{{{Key::F6}}, toggleTour, "Tour", "What the filters do and where they fail, in a few stops.",
           [](State s) { return s.tourStop.has_value(); }}}},
        {"Page down, up", "next, previous stop",
         {{{{Key::PageDown}}, call(nextStop, 1)}, {{{Key::PageUp}}, call(nextStop, -1)}}},
        {"F11", "wait for the screen, or not", {flip(Key::F11, &Preferences::vsync)}},
        {"F1", "this overview", {flip(Key::F1, &ViewState::showHelp, "F1", "All keys")}},
        {"Esc", "close what is open", {{{{Key::Escape}}, dismiss}}},
        {"Ctrl Q", "quit", {{{control('Q')}, [](ViewState& s) { s.quit = true; }}}}}},
    };
}
// clang-format on

std::string nameOf(KeyStroke stroke) {
    std::string name = std::string(stroke.control ? "Ctrl " : "") + (stroke.shift ? "Shift " : "");
    if (stroke.key >= Key::F1 && stroke.key <= Key::F12)
        return name + "F" + std::to_string(int(stroke.key) - int(Key::F1) + 1);
    for (const auto& [key, word] : {std::pair{Key::Space, "Space"},
                                    {Key::Backspace, "Backspace"},
                                    {Key::Home, "Home"},
                                    {keyOf('.'), "Full stop"}})
        if (key == stroke.key)
            return name + word;
    return name + char(stroke.key);
}

} // namespace

const std::vector<KeyGroup>& keyGroups() {
    static const std::vector<KeyGroup> groups = allGroups();
    return groups;
}

const Action* actionOf(KeyStroke stroke) {
    for (const KeyGroup& group : keyGroups())
        for (const KeyRow& row : group.rows)
            for (const Action& action : row.actions)
                if (std::ranges::find(action.strokes, stroke) != action.strokes.end())
                    return &action;
    return nullptr;
}

void press(ViewState& state, KeyStroke stroke) {
    if (const Action* const action = actionOf(stroke))
        action->perform(state);
}

std::string tipOf(const Action& action) {
    std::string names;
    for (const KeyStroke stroke : action.strokes)
        names += (names.empty() ? "" : " or ") + nameOf(stroke);
    return names + (*action.tip == 0 ? "" : ". ") + action.tip;
}

} // namespace afterglow
