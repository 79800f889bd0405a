// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace afterglow {

/// A key by its place on a US keyboard. Letters (upper case), digits and signs have their ASCII
/// code.
enum class Key : int {
    Unknown = 0,
    Space = ' ',
    Escape = 256,
    Tab,
    Backspace,
    Home,
    PageUp,
    PageDown,
    Left,
    Right,
    Up,
    Down,
    Shift,
    Control,
    F1,
    F2,
    F3,
    F4,
    F5,
    F6,
    F7,
    F8,
    F9,
    F10,
    F11,
    F12
};
constexpr Key keyOf(char character) {
    return Key(character);
}

struct KeyStroke {
    Key key = Key::Unknown;
    bool control = false, shift = false;
    bool operator==(const KeyStroke&) const = default;
};

/// The actions of single keys. Held keys fly the camera; see FlyInput.
enum class Action {
    NextFilter,
    PreviousFilter,
    ResetHistory,
    NextLayout,
    PreviousLayout,
    NextPane,
    PreviousPane,
    SwapPair,
    DividerLeft,
    DividerRight,
    ToggleLight, ///< Command::index is its slot
    DimLight,    ///< likewise
    ColorLight,  ///< likewise
    ToggleKeyLight,
    Brighter,
    Darker,
    TogglePause,
    StepOnce,
    NextPass,
    PreviousPass,
    Slower,
    Faster,
    MarkIn,
    MarkOut,
    Replay,
    StopTake,
    SaveTake,
    ToggleRepeat,
    ToggleAnimation,
    CutCamera,
    ToggleCameraPath,
    GoHome,
    AddBookmark,
    GoToBookmark, ///< Command::index
    NextImage,
    PreviousImage,
    ShowPicture,
    FinerPixels,
    CoarserPixels,
    ProbeHere,
    ClearProbes,
    NextCurve,
    CopyCurves,
    SaveCurves,
    PinInspector,
    Freeze,
    NextOracle,
    SavePicture,
    SaveWindow,
    SaveImageFiles,
    RecordFrames,
    CopyPreset,
    PastePreset,
    ReloadShaders,
    TogglePanel,
    ToggleInspector,
    ToggleCurves,
    TogglePasses,
    ToggleStrip,
    TogglePresets,
    ToggleTour,
    NextStop,
    PreviousStop,
    ToggleVsync,
    FocusPanel,
    ToggleHelp,
    Dismiss,
    Quit
};

struct Command {
    Action action;
    int index = 0;
    bool operator==(const Command&) const = default;
};

/// One row of the key overview; from the same table commandFor() reads.
struct KeyHelp {
    std::string_view group, keys, meaning;
};
std::span<const KeyHelp> keyHelp();

/// Returns the command of a stroke, or nothing. Strokes with Control never mean what they mean
/// without.
std::optional<Command> commandFor(KeyStroke stroke);

} // namespace afterglow
