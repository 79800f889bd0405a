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

/// A button that does what a key does, with that action's label and tip.
enum class ButtonStyle { Lit, Quiet };
void actionButton(ViewState& state, KeyStroke stroke, float width,
                  ButtonStyle style = ButtonStyle::Lit);
/// Draws such buttons side by side, of equal width.
void actionRow(ViewState& state, std::initializer_list<KeyStroke> strokes, float width,
               ButtonStyle style = ButtonStyle::Lit);

/// A row of choices beside each other, of which one is lit. Returns what was pressed.
std::optional<int> segments(const char* label, std::span<const char* const> names, int lit,
                            const std::string& tip);

/// A row with a switch; true when it was turned.
bool switchRow(const char* label, bool on, const std::string& tip);

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

/// Writes text; without a font in the present one.
void write(std::string_view text, ImVec4 tint = color::kText, ImFont* font = nullptr);
void dimText(std::string_view text, ImFont* font = nullptr);
void dimWrapped(std::string_view text, ImFont* font = nullptr);

/// Letters are in another font until the end of the scope.
class WithFont {
public:
    explicit WithFont(ImFont* font) { ImGui::PushFont(font); }
    ~WithFont() { ImGui::PopFont(); }
    WithFont(const WithFont&) = delete;
    WithFont& operator=(const WithFont&) = delete;
};

/// A window over the pictures that cannot be moved, from here to the end of the scope.
struct OverlayLook {
    float alpha;            ///< of its ground
    ImVec2 padding;         ///< em
    float rounding = 0.45f; ///< em
    bool hasBorder = false;
    ImGuiWindowFlags more = 0; ///< beside those of all overlays
};
inline constexpr ImGuiWindowFlags kUntouched =
    ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoInputs;
class Overlay {
public:
    Overlay(const char* name, const OverlayLook& look);
    ~Overlay();
    Overlay(const Overlay&) = delete;
    Overlay& operator=(const Overlay&) = delete;
};

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

/// A choice among values by their names; true when one was chosen, also the same again.
template <class Value, class Values, class NameOf>
bool choose(const char* id, Value& value, const Values& values, NameOf nameOf) {
    bool chosen = false;
    if (!ImGui::BeginCombo(id, std::string(nameOf(value)).c_str(), ImGuiComboFlags_HeightLarge))
        return false;
    for (const auto& other : values)
        if (ImGui::Selectable(std::string(nameOf(other)).c_str(), other == value)) {
            value = other;
            chosen = true;
        }
    ImGui::EndCombo();
    return chosen;
}
template <class Value, class Values, class NameOf>
bool chooseRow(const char* label, Value& value, const Values& values, NameOf nameOf,
               const char* tip) {
    rowLabel(label);
    const bool chosen = choose((std::string("##") + label).c_str(), value, values, nameOf);
    tooltip(tip);
    return chosen;
}

} // namespace afterglow
