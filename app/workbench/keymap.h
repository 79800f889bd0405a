// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace afterglow {

struct ViewState;

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
constexpr KeyStroke plain(char key) {
    return {keyOf(key)};
}
constexpr KeyStroke shift(char key) {
    return {.key = keyOf(key), .shift = true};
}
constexpr KeyStroke control(char key) {
    return {.key = keyOf(key), .control = true};
}

/// Something that a person can do by a key and, where it has a label, by a button. Held keys fly
/// the camera; see FlyInput.
struct Action {
    std::vector<KeyStroke> strokes; ///< any of them
    std::function<void(ViewState&)> perform;
    const char *label = "", *tip = "";                  ///< of its button
    std::function<bool(const ViewState&)> isLit{};      ///< empty: never
    std::function<bool(const ViewState&)> isPossible{}; ///< empty: always
    bool records = false;                               ///< while it is lit
};

/// Actions that the key overview names together, in a group of such rows.
struct KeyRow {
    std::string_view keys, meaning;
    std::vector<Action> actions;
};
struct KeyGroup {
    std::string_view title;
    std::vector<KeyRow> rows;
};
/// Returns all that keys do: the keyboard is read by it, and buttons and overview are made from it.
const std::vector<KeyGroup>& keyGroups();

/// Returns the action of a stroke, or null. Strokes with Control never mean what they mean without.
const Action* actionOf(KeyStroke stroke);

/// Does what a stroke means, if anything.
void press(ViewState& state, KeyStroke stroke);

/// Returns what the button of an action tells: "P or Space. While paused nothing is rendered."
std::string tipOf(const Action& action);

} // namespace afterglow
