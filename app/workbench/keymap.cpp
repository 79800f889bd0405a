// SPDX-License-Identifier: MIT
#include "app/workbench/keymap.h"

#include <algorithm>
#include <array>
#include <vector>

namespace afterglow {
namespace {

struct Row {
    KeyHelp help;
    std::vector<std::pair<KeyStroke, Command>> strokes;
};

KeyStroke plain(char key) {
    return {keyOf(key)};
}
KeyStroke shifted(char key) {
    return {.key = keyOf(key), .shift = true};
}
KeyStroke controlled(char key) {
    return {.key = keyOf(key), .control = true};
}

/// Returns the number row with these modifiers, from 1 on.
std::vector<std::pair<KeyStroke, Command>> numberRow(Action action, bool control, bool shift) {
    std::vector<std::pair<KeyStroke, Command>> strokes;
    for (int slot = 0; slot < 9; ++slot)
        strokes.push_back({{keyOf(char('1' + slot)), control, shift}, {action, slot}});
    return strokes;
}

const std::vector<Row>& rows() {
    using enum Action;
    static const std::vector<Row> table = {
        {{"Filter", "F, Shift F", "next, previous filter of the active pane"},
         {{plain('F'), {NextFilter}}, {shifted('F'), {PreviousFilter}}}},
        {{"Filter", "T, Shift T", "single, wipe, two up, four up, difference"},
         {{plain('T'), {NextLayout}}, {shifted('T'), {PreviousLayout}}}},
        {{"Filter", "G, Shift G", "next, previous pane"},
         {{plain('G'), {NextPane}}, {shifted('G'), {PreviousPane}}}},
        {{"Filter", "X", "swap the two panes"}, {{plain('X'), {SwapPair}}}},
        {{"Filter", "\xe2\x86\x90 \xe2\x86\x92", "move the divider of a wipe"},
         {{{Key::Left}, {DividerLeft}}, {{Key::Right}, {DividerRight}}}},
        {{"Filter", "H", "forget all history"}, {{plain('H'), {ResetHistory}}}},
        {{"Filter", "F7", "presets and lineages"}, {{{Key::F7}, {TogglePresets}}}},
        {{"Filter", "Ctrl Shift C, V", "copy, paste a preset"},
         {{{keyOf('C'), true, true}, {CopyPreset}}, {{keyOf('V'), true, true}, {PastePreset}}}},

        {{"Light", "1 - 9", "switch a light on or off"}, numberRow(ToggleLight, false, false)},
        {{"Light", "Shift 1 - 9", "dim it to a half"}, numberRow(DimLight, false, true)},
        {{"Light", "Ctrl 1 - 9", "another color, equal luminance"},
         numberRow(ColorLight, true, false)},
        {{"Light", "L", "switch the key light"}, {{plain('L'), {ToggleKeyLight}}}},
        {{"Light", "] [", "half a stop brighter, darker"},
         {{plain(']'), {Brighter}}, {plain('['), {Darker}}}},

        {{"Time", "P, Space", "pause or resume"},
         {{plain('P'), {TogglePause}}, {{Key::Space}, {TogglePause}}}},
        {{"Time", "N", "render one frame, then pause"}, {{plain('N'), {StepOnce}}}},
        {{"Time", ". ,", "next, previous pass of a frame"},
         {{plain('.'), {NextPass}}, {plain(','), {PreviousPass}}}},
        {{"Time", "K, Shift K", "slower, faster"},
         {{plain('K'), {Slower}}, {shifted('K'), {Faster}}}},
        {{"Time", "I, O", "in point; out point: loop between them"},
         {{plain('I'), {MarkIn}}, {plain('O'), {MarkOut}}}},
        {{"Time", "Shift O", "loop the last take again"}, {{shifted('O'), {Replay}}}},
        {{"Time", "Backspace", "leave the take"}, {{{Key::Backspace}, {StopTake}}}},
        {{"Time", "Ctrl T", "save the take as an experiment"}, {{controlled('T'), {SaveTake}}}},
        {{"Time", "Y", "repeat the last event, or stop that"}, {{plain('Y'), {ToggleRepeat}}}},
        {{"Time", "M", "play or stop the scene's movement"}, {{plain('M'), {ToggleAnimation}}}},

        {{"Camera", "W A S D", "fly"}, {}},
        {{"Camera", "Q, E", "down, up"}, {}},
        {{"Camera", "Shift", "four times faster"}, {}},
        {{"Camera", "Right drag", "look around"}, {}},
        {{"Camera", "Wheel", "flying speed"}, {}},
        {{"Camera", "R, Home", "back to the scene's camera"},
         {{plain('R'), {GoHome}}, {{Key::Home}, {GoHome}}}},
        {{"Camera", "C, Shift C", "camera cut; camera path"},
         {{plain('C'), {CutCamera}}, {shifted('C'), {ToggleCameraPath}}}},
        {{"Camera", "Ctrl B", "remember this place"}, {{controlled('B'), {AddBookmark}}}},
        {{"Camera", "Ctrl Shift 1 - 9", "go to a remembered place"},
         numberRow(GoToBookmark, true, true)},

        {{"View", "V, Shift V", "next, previous image of the frame"},
         {{plain('V'), {NextImage}}, {shifted('V'), {PreviousImage}}}},
        {{"View", "B", "back to the picture"}, {{plain('B'), {ShowPicture}}}},
        {{"View", "+ -", "render more, fewer pixels"},
         {{plain('='), {FinerPixels}},
          {shifted('='), {FinerPixels}},
          {plain('-'), {CoarserPixels}}}},
        {{"View", "U", "freeze: converge the truth"}, {{plain('U'), {Freeze}}}},
        {{"View", "Shift U", "next view of the truth"}, {{shifted('U'), {NextOracle}}}},

        {{"Measure", "Click, drag", "set a probe"}, {}},
        {{"Measure", "J, Shift J", "a probe at the mouse; no probes"},
         {{plain('J'), {ProbeHere}}, {shifted('J'), {ClearProbes}}}},
        {{"Measure", "Z", "next quantity of the curves"}, {{plain('Z'), {NextCurve}}}},
        {{"Measure", "Ctrl C, Ctrl E", "copy, save the curves as CSV"},
         {{controlled('C'), {CopyCurves}}, {controlled('E'), {SaveCurves}}}},
        {{"Measure", "Ctrl I", "hold the inspector on this pixel"},
         {{controlled('I'), {PinInspector}}}},

        {{"Files", "F12, Ctrl S", "save the picture as PNG"},
         {{{Key::F12}, {SavePicture}}, {controlled('S'), {SavePicture}}}},
        {{"Files", "Shift F12", "save the whole window as PNG"},
         {{{.key = Key::F12, .shift = true}, {SaveWindow}}}},
        {{"Files", "Ctrl F12", "save every image of the frame"},
         {{{.key = Key::F12, .control = true}, {SaveImageFiles}}}},
        {{"Files", "F9", "record frames, or end that"}, {{{Key::F9}, {RecordFrames}}}},
        {{"Files", "F5", "reload the shaders"}, {{{Key::F5}, {ReloadShaders}}}},

        {{"Window", "Tab", "hide or show the panel"}, {{{Key::Tab}, {TogglePanel}}}},
        {{"Window", "F10", "keyboard in the panel; Esc leaves it"}, {{{Key::F10}, {FocusPanel}}}},
        {{"Window", "F2, F3, F4", "inspector, passes, curves"},
         {{{Key::F2}, {ToggleInspector}},
          {{Key::F3}, {TogglePasses}},
          {{Key::F4}, {ToggleCurves}}}},
        {{"Window", "F8", "timeline"}, {{{Key::F8}, {ToggleStrip}}}},
        {{"Window", "F6", "guided tour"}, {{{Key::F6}, {ToggleTour}}}},
        {{"Window", "Page down, up", "next, previous stop"},
         {{{Key::PageDown}, {NextStop}}, {{Key::PageUp}, {PreviousStop}}}},
        {{"Window", "F11", "wait for the screen, or not"}, {{{Key::F11}, {ToggleVsync}}}},
        {{"Window", "F1", "this overview"}, {{{Key::F1}, {ToggleHelp}}}},
        {{"Window", "Esc", "close what is open"}, {{{Key::Escape}, {Dismiss}}}},
        {{"Window", "Ctrl Q", "quit"}, {{controlled('Q'), {Quit}}}},
    };
    return table;
}

} // namespace

std::span<const KeyHelp> keyHelp() {
    static const std::vector<KeyHelp> help = [] {
        std::vector<KeyHelp> all;
        for (const Row& row : rows())
            all.push_back(row.help);
        return all;
    }();
    return help;
}

std::optional<Command> commandFor(KeyStroke stroke) {
    for (const Row& row : rows())
        for (const auto& [known, command] : row.strokes)
            if (known == stroke)
                return command;
    return {};
}

} // namespace afterglow
