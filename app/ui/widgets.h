#pragma once

#include "app/ui/theme.h"
#include "renderer/pipeline/settings.h"

#include <string>
#include <string_view>

namespace afterglow {

// The few widgets that Dear ImGui does not have. Sizes follow the current font and style.

/// A heading that opens and closes what follows it. Remembers, and starts as told.
bool section(const Fonts& fonts, const char* title, bool openAtFirst);

/// A switch with a knob; true when it was turned.
bool switchButton(const char* id, bool on);

/// A round arrow; true when it was pressed.
bool resetButton(const char* id);

/// A key cap before its meaning.
void keyCap(std::string_view keys);

/// A button of the width given that stays lit while `lit`.
bool litButton(const char* label, bool lit, float width);

/// Shown while the mouse rests on the item before it; wrapped.
void tooltip(const std::string& text);

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

/// Label, slider or choice and a way back to the default, for one field of the table. Ctrl-click
/// types.
void fieldRow(Settings& settings, const Field& field);

/// A label in the left column of a row; what comes next fills the rest.
void rowLabel(std::string_view label);

float labelColumn();

} // namespace afterglow
