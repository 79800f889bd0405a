// SPDX-License-Identifier: MIT
#pragma once

#include "app/ui/panels.h"

#include <cstdio>
#include <string>
#include <string_view>

#include <imgui.h>

namespace afterglow {

// What overlays and docks are drawn with.

float em(); ///< height of the letters; sizes follow from it

/// In units of the interface; Rect is in framebuffer pixels.
struct UiRect {
    ImVec2 min, size;
    ImVec2 end() const { return {min.x + size.x, min.y + size.y}; }
};
UiRect inUnits(const PanelContext& panel, const Rect& rect);
ImVec2 inUnits(const PanelContext& panel, glm::vec2 position);
/// A box of pixels of the rendered image, in a pane.
UiRect inUnits(const PanelContext& panel, const PanePlace& place, const Probe& box);

ImU32 faded(ImU32 color, float alpha); ///< its own alpha times `alpha`

float widthOf(std::string_view text);
/// As much of it as there is room for, ending in dots where some is left out.
std::string clipped(std::string_view text, float width);

/// As std::snprintf(), up to 199 characters.
template <class... Values>
std::string formatted(const char* format, Values... values) {
    char text[200];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

/// The letter of a pane or of a probe on its color; a square of letterSize().
void drawLetter(ImDrawList& draw, ImVec2 at, std::size_t index, ImU32 ground);
float letterSize();

/// A line between the current window and what is beside it.
void drawEdge(ImVec2 from, ImVec2 to);

enum class Icon { Pause, Play, Step };
/// A button as high as others and a little wider than that.
bool iconButton(const char* id, Icon icon, bool lit);

/// Text whose right end is there.
void textUpTo(ImDrawList& draw, ImVec2 rightTop, ImU32 color, std::string_view text);

} // namespace afterglow
