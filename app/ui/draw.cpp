// SPDX-License-Identifier: MIT
#include "app/ui/draw.h"

#include "app/ui/theme.h"

#include <algorithm>
#include <cmath>

namespace afterglow {

float em() {
    return ImGui::GetFontSize();
}

UiRect inUnits(const PanelContext& panel, const Rect& rect) {
    return {inUnits(panel, glm::vec2(rect.min)), inUnits(panel, glm::vec2(rect.size))};
}

ImVec2 inUnits(const PanelContext& panel, glm::vec2 position) {
    return {position.x * panel.scale, position.y * panel.scale};
}

UiRect inUnits(const PanelContext& panel, const PanePlace& place, const Probe& box) {
    const glm::ivec2 image = panel.bench.imageSize();
    const ImVec2 low = inUnits(panel, positionOf(place, glm::vec2(box.min), image));
    const ImVec2 high = inUnits(panel, positionOf(place, glm::vec2(box.min + box.size), image));
    return {low, {high.x - low.x, high.y - low.y}};
}

ImU32 faded(ImU32 color, float alpha) {
    ImVec4 parts = ImGui::ColorConvertU32ToFloat4(color);
    parts.w *= alpha;
    return packed(parts);
}

float widthOf(std::string_view text) {
    return ImGui::CalcTextSize(text.data(), text.data() + text.size()).x;
}

std::string clipped(std::string_view text, float width) {
    if (widthOf(text) <= width)
        return std::string(text);
    const float dots = widthOf("...");
    const auto isInside = [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) == 0x80u; };
    while (!text.empty() && widthOf(text) + dots > width) {
        while (text.size() > 1 && isInside(text.back())) // of a character of several bytes
            text.remove_suffix(1);
        text.remove_suffix(1);
    }
    while (text.ends_with(' '))
        text.remove_suffix(1);
    return text.empty() ? std::string() : std::string(text) + "...";
}

float letterSize() {
    return 1.3f * em();
}

void drawLetter(ImDrawList& draw, ImVec2 at, std::size_t index, ImU32 ground) {
    const float size = letterSize();
    const char letter[] = {letterOf(index), '\0'};
    draw.AddRectFilled(at, {at.x + size, at.y + size}, ground, 0.25f * em());
    draw.AddText({std::round(at.x + 0.5f * (size - widthOf(letter))),
                  std::round(at.y + 0.5f * (size - em()))},
                 packed(color::kOnAccent), letter);
}

void drawEdge(ImVec2 from, ImVec2 to) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.PushClipRectFullScreen();
    draw.AddRectFilled(from, {std::max(to.x, from.x + 1.0f), std::max(to.y, from.y + 1.0f)},
                       packed(color::kLine));
    draw.PopClipRect();
}

bool iconButton(const char* id, Icon icon, bool lit) {
    const float size = ImGui::GetFrameHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::PushStyleColor(ImGuiCol_Button, lit ? color::kLit : color::kFrame);
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, lit ? color::kAccent : color::kFrameHovered);
    ImGui::PushStyleColor(ImGuiCol_ButtonActive, lit ? color::kAccent : color::kFrameActive);
    const bool pressed = ImGui::Button((std::string("##") + id).c_str(), {1.25f * size, size});
    ImGui::PopStyleColor(3);

    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImU32 tint = packed(lit ? color::kOnAccent : color::kText);
    const ImVec2 c{at.x + 0.625f * size, at.y + 0.5f * size};
    const float s = 0.22f * size;
    switch (icon) {
    case Icon::Pause:
        draw.AddRectFilled({c.x - s, c.y - s}, {c.x - 0.3f * s, c.y + s}, tint);
        draw.AddRectFilled({c.x + 0.3f * s, c.y - s}, {c.x + s, c.y + s}, tint);
        break;
    case Icon::Play:
        draw.AddTriangleFilled({c.x - 0.8f * s, c.y - 1.1f * s}, {c.x + 1.1f * s, c.y},
                               {c.x - 0.8f * s, c.y + 1.1f * s}, tint);
        break;
    case Icon::Step:
        draw.AddTriangleFilled({c.x - s, c.y - s}, {c.x + 0.5f * s, c.y}, {c.x - s, c.y + s}, tint);
        draw.AddRectFilled({c.x + 0.5f * s, c.y - s}, {c.x + 1.1f * s, c.y + s}, tint);
        break;
    }
    return pressed;
}

void textUpTo(ImDrawList& draw, ImVec2 rightTop, ImU32 color, std::string_view text) {
    draw.AddText({std::round(rightTop.x - widthOf(text)), std::round(rightTop.y)}, color,
                 text.data(), text.data() + text.size());
}

} // namespace afterglow
