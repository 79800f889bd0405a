// SPDX-License-Identifier: MIT
#pragma once

#include "app/ui/theme.h"
#include "app/workbench/view_state.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace afterglow {

// The few widgets that Dear ImGui does not have. Sizes follow the current font and style.

/// A heading that opens and closes what follows it. Remembers, and starts as told. `note`: beside
/// the title.
bool section(const Fonts& fonts, const char* title, bool openAtFirst, std::string_view note = {},
             ImVec4 noteColor = color::kDim);

/// A small heading inside a list.
void groupTitle(const Fonts& fonts, const char* title);

/// A switch with a knob; true when it was turned.
bool switchButton(const char* id, bool on);

/// A round arrow; true when it was pressed.
bool resetButton(const char* id);

/// A key cap before its meaning.
void keyCap(std::string_view keys);

/// A button of the width given that stays lit while `lit`.
bool litButton(const char* label, bool lit, float width, ImVec4 tint = color::kLit);

/// The same for what matters less: its ground stays calm.
bool quietButton(const char* label, bool lit, float width);

/// A button that does what a key does.
struct ActionButton {
    const char *label, *help;
    Action action;
    bool lit = false, can = true;
};
void actionButton(ViewState& state, const ActionButton& button, float width);
/// Draws action buttons side by side, of equal width, in the style of quietButton().
void actionRow(ViewState& state, std::span<const ActionButton> buttons, float width);

/// Choices beside each other over the width that is left, of which one is lit. What was pressed.
std::optional<int> segments(const char* id, std::span<const char* const> names, int lit);

/// Around the item before it while the keyboard is on it; for items that do not draw it themselves.
void focusRing();

/// Width of each of `count` things beside each other.
float shareOf(int count, float gap);

/// Shown while the mouse rests on the item before it; wrapped.
void tooltip(const std::string& text);

/// The middle of a window of this width: beside what ends at `panelEnd` if there is room for it,
/// else of the whole screen.
ImVec2 middleBeside(float panelEnd, float width);

/// Text that ends in dots where the room ends; true if some was left out.
bool clippedText(std::string_view text, float width);

void dimText(std::string_view text);
void dimWrapped(std::string_view text);

/// A slider whose bar is filled up to its value, or from zero where zero is inside the range. True
/// when it was moved. Its width is as for the next item.
struct SliderRange {
    double min, max;
    bool logarithmic = false;
};
bool slider(const char* id, double& value, SliderRange range, const char* format);

/// Label, slider or choice and a way back to the default, for one field of the active pane, or of
/// all where it is frame-wide. Ctrl-click types.
void fieldRow(Panes& panes, const Field& field);

/// A label in the left column of a row; what comes next fills the rest.
void rowLabel(std::string_view label);

float labelColumn();

} // namespace afterglow
