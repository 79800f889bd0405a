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

std::vector<std::pair<KeyStroke, Command>> numberRow() {
    std::vector<std::pair<KeyStroke, Command>> strokes;
    for (int slot = 0; slot < 9; ++slot)
        strokes.push_back({plain(char('1' + slot)), {Action::ToggleLight, slot}});
    return strokes;
}

const std::vector<Row>& rows() {
    using enum Action;
    static const std::vector<Row> table = {
        {{"Filter", "F", "next filter"}, {{plain('F'), {NextFilter}}}},
        {{"Filter", "Shift F", "previous filter"}, {{shifted('F'), {PreviousFilter}}}},
        {{"Filter", "H", "forget all history"}, {{plain('H'), {ResetHistory}}}},
        {{"Light", "1 - 9", "switch a light on or off"}, numberRow()},
        {{"Light", "L", "switch the key light"}, {{plain('L'), {ToggleKeyLight}}}},
        {{"Light", "]", "half a stop brighter"}, {{plain(']'), {Brighter}}}},
        {{"Light", "[", "half a stop darker"}, {{plain('['), {Darker}}}},
        {{"Time", "P, Space", "pause or resume"},
         {{plain('P'), {TogglePause}}, {{Key::Space}, {TogglePause}}}},
        {{"Time", "N", "render one frame, then pause"}, {{plain('N'), {StepOnce}}}},
        {{"Time", "M", "play or stop the scene's movement"}, {{plain('M'), {ToggleAnimation}}}},
        {{"Camera", "W A S D", "fly"}, {}},
        {{"Camera", "Q, E", "down, up"}, {}},
        {{"Camera", "Shift", "four times faster"}, {}},
        {{"Camera", "Right drag", "look around"}, {}},
        {{"Camera", "Wheel", "flying speed"}, {}},
        {{"Camera", "R, Home", "back to the scene's camera"},
         {{plain('R'), {GoHome}}, {{Key::Home}, {GoHome}}}},
        {{"View", "V, Shift V", "next, previous image of the frame"},
         {{plain('V'), {NextImage}}, {shifted('V'), {PreviousImage}}}},
        {{"View", "B", "back to the picture"}, {{plain('B'), {ShowPicture}}}},
        {{"View", "+", "render more pixels"},
         {{plain('='), {FinerPixels}}, {shifted('='), {FinerPixels}}}},
        {{"View", "-", "render fewer pixels"}, {{plain('-'), {CoarserPixels}}}},
        {{"View", "F12, Ctrl S", "save the picture as PNG"},
         {{{Key::F12}, {SavePicture}}, {controlled('S'), {SavePicture}}}},
        {{"View", "Shift F12", "save the whole window as PNG"},
         {{{.key = Key::F12, .shift = true}, {SaveWindow}}}},
        {{"Window", "Tab", "hide or show the panel"}, {{{Key::Tab}, {TogglePanel}}}},
        {{"Window", "F1", "this overview"}, {{{Key::F1}, {ToggleHelp}}}},
        {{"Window", "Esc", "close the overview"}, {{{Key::Escape}, {Dismiss}}}},
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
