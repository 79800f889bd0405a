// SPDX-License-Identifier: MIT
// Sliders, and the row of one tunable.

#include "app/ui/draw.h"
#include "app/ui/widgets.h"
#include "app/workbench/fields.h"

#include <algorithm>
#include <cmath>
#include <ranges>

#include <fmt/format.h>

namespace afterglow {
namespace {

bool isWhole(const Field& field) {
    Settings any;
    return std::holds_alternative<int*>(field.in(any));
}

std::string formatOf(const Field& field) {
    std::string format = isWhole(field) ? "%.0f" : "%.4g";
    if (!field.unit.empty() && field.unit.size() <= 8)
        format += " " + std::string(field.unit);
    return format;
}

std::string helpOf(const Settings& settings, const Field& field) {
    const std::string range = field.choices.empty()
                                  ? fmt::format("\nRange {:.4g} to {}. Ctrl-click to type.",
                                                field.min, valueText(field, field.max))
                                  : "";
    return fmt::format("{}\n{}{}\nDefault {} ({}).{}\nOn the command line: --set {}=", field.label,
                       field.meaning, range, valueText(field, defaultValue(settings, field)),
                       field.source, field.isFrameWide() ? "\nFor all panes." : "", field.key);
}

} // namespace

bool slider(const char* id, double& value, SliderRange range, const char* format) {
    const auto place = [range](double x) {
        const double t = range.logarithmic
                             ? std::log(x / range.min) / std::log(range.max / range.min)
                             : (x - range.min) / (range.max - range.min);
        return float(std::clamp(t, 0.0, 1.0));
    };
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 size{ImGui::CalcItemWidth(), ImGui::GetFrameHeight()};
    const float rounding = ImGui::GetStyle().FrameRounding;
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled(at, {at.x + size.x, at.y + size.y}, packed(color::kFrame), rounding);
    const float zero = range.logarithmic || range.min >= 0.0 ? 0.0f : place(0.0);
    const float low = at.x + size.x * std::min(zero, place(value));
    const float high = at.x + size.x * std::max(zero, place(value));
    draw->PushClipRect({low, at.y}, {high, at.y + size.y}, true); // so that the corners stay round
    draw->AddRectFilled(at, {at.x + size.x, at.y + size.y}, packed(color::kFill), rounding);
    draw->PopClipRect();
    const float mark = std::clamp(at.x + size.x * place(value), at.x + 2.0f, at.x + size.x - 2.0f);
    const bool underNumber = std::abs(mark - (at.x + 0.5f * size.x)) < 1.9f * em();
    const float top = at.y + (underNumber ? 0.8f * size.y : 2.0f);
    draw->AddRectFilled({mark - 1.0f, top}, {mark + 1.0f, at.y + size.y - 2.0f},
                        packed(color::kAccent));

    const ImVec4 none{0, 0, 0, 0};
    ImGui::PushStyleColor(ImGuiCol_FrameBg, none);
    ImGui::PushStyleColor(ImGuiCol_FrameBgHovered, color::rgb(0xffffff, 0.05f));
    ImGui::PushStyleColor(ImGuiCol_FrameBgActive, color::rgb(0xffffff, 0.09f));
    ImGui::PushStyleColor(ImGuiCol_SliderGrab, none);
    ImGui::PushStyleColor(ImGuiCol_SliderGrabActive, none);
    const bool moved = ImGui::SliderScalar(
        id, ImGuiDataType_Double, &value, &range.min, &range.max, format,
        ImGuiSliderFlags_AlwaysClamp | (range.logarithmic ? ImGuiSliderFlags_Logarithmic : 0));
    ImGui::PopStyleColor(5);
    return moved;
}

void fieldRow(Panes& panes, const Field& field) {
    const Settings settings = settingsOf(panes, panes.active);
    ImGui::PushID(field.key.data(), field.key.data() + field.key.size());
    // The heading of the group says what a label repeats in brackets.
    std::string_view label = field.label;
    if (const auto bracket = label.find(" ("); bracket != label.npos)
        label = label.substr(0, bracket);
    const float reset = 0.8f * ImGui::GetFrameHeight();
    const bool changed = !isDefault(settings, field);
    rowLabel(label);
    tooltip(helpOf(settings, field));

    const double value = fieldValue(settings, field);
    ImGui::SetNextItemWidth(-reset - 0.3f * em());
    if (!field.choices.empty()) {
        auto choice = std::size_t(value);
        const auto nameOf = [&](std::size_t i) { return field.choices[i]; };
        if (choose("##choice", choice, std::views::iota(std::size_t(0), field.choices.size()),
                   nameOf))
            setField(panes, field, double(choice));
    } else {
        double moved = value;
        if (slider("##value", moved, {field.min, field.max, field.logarithmic},
                   formatOf(field).c_str()))
            setField(panes, field, moved);
    }
    tooltip(helpOf(settings, field));
    if (changed) {
        ImGui::SameLine(0.0f, 0.3f * em());
        if (resetButton("reset"))
            setField(panes, field, defaultValue(settings, field));
        tooltip("Back to " + valueText(field, defaultValue(settings, field)));
    }
    ImGui::PopID();
}

} // namespace afterglow
