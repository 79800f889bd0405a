#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace afterglow {

/// A key by its place on a US keyboard. Letters (upper case), digits and signs have their ASCII
/// code.
enum class Key : int { Unknown = 0, Space = ' ', Escape = 256, Tab, Home, Shift, Control, F1, F12 };
constexpr Key keyOf(char character) {
    return Key(character);
}

struct KeyStroke {
    Key key = Key::Unknown;
    bool control = false, shift = false;
    bool operator==(const KeyStroke&) const = default;
};

/// Everything that one key can do at once. Held keys fly the camera; see FlyInput.
enum class Action {
    NextFilter,
    PreviousFilter,
    ToggleLight, ///< Command::index is its slot
    ToggleKeyLight,
    TogglePause,
    StepOnce,
    ToggleAnimation,
    ResetHistory,
    GoHome,
    NextImage,
    PreviousImage,
    ShowPicture,
    Brighter,
    Darker,
    FinerPixels,
    CoarserPixels,
    SavePicture,
    SaveWindow,
    TogglePanel,
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

/// What a stroke means, or nothing. Strokes with Control never mean what they mean without.
std::optional<Command> commandFor(KeyStroke stroke);

} // namespace afterglow
