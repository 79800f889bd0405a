#include "app/ui/widgets.h"

#include "app/workbench/view_state.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace afterglow {
namespace {

float em() {
    return ImGui::GetFontSize();
}

void text(std::string_view words) {
    ImGui::TextUnformatted(words.data(), words.data() + words.size());
}

float widthOf(std::string_view words) {
    return ImGui::CalcTextSize(words.data(), words.data() + words.size()).x;
}

// An arrow that goes back in a circle.
void drawResetIcon(ImVec2 center, float radius, ImU32 tint) {
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    constexpr float begin = -2.2f, end = 2.6f; // radians
    draw->PathArcTo(center, radius, begin, end, 24);
    draw->PathStroke(tint, 0, std::max(1.5f, radius * 0.25f));
    const ImVec2 out{std::cos(begin), std::sin(begin)}; // from the center
    const ImVec2 ahead{out.y, -out.x};                  // along the circle, backwards
    const ImVec2 foot{center.x + radius * out.x, center.y + radius * out.y};
    const float s = radius * 0.7f;
    draw->AddTriangleFilled({foot.x + s * ahead.x, foot.y + s * ahead.y},
                            {foot.x + s * out.x, foot.y + s * out.y},
                            {foot.x - s * out.x, foot.y - s * out.y}, tint);
}

bool isWhole(const Field& field) {
    Settings any;
    return std::holds_alternative<int*>(field.ref(any));
}

std::string formatOf(const Field& field) {
    std::string format = isWhole(field) ? "%.0f" : "%.4g";
    if (!field.unit.empty() && field.unit.size() <= 8)
        format += " " + std::string(field.unit);
    return format;
}

std::string number(double value) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.4g", value);
    return digits;
}

std::string valueText(const Field& field, double value) {
    if (!field.choices.empty())
        return std::string(field.choices[std::size_t(value)]);
    return number(value) + (field.unit.empty() ? "" : " " + std::string(field.unit));
}

std::string helpOf(const Field& field) {
    std::string help{field.label};
    help += "\n" + std::string(field.meaning);
    if (field.choices.empty())
        help += "\nRange " + number(field.min) + " to " + number(field.max) +
                (field.unit.empty() ? "" : " " + std::string(field.unit)) + ". Ctrl-click to type.";
    help += "\nDefault " + valueText(field, fieldValue(Settings{}, field)) + " (" +
            std::string(field.source) + ").";
    help += "\nOn the command line: --set " + std::string(field.key) + "=";
    return help;
}

} // namespace

bool resetButton(const char* id) {
    const float size = ImGui::GetFrameHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool pressed = ImGui::InvisibleButton(id, {size * 0.8f, size});
    drawResetIcon({at.x + size * 0.42f, at.y + size * 0.5f}, size * 0.23f,
                  packed(ImGui::IsItemHovered() ? color::kAccent : color::kDim));
    return pressed;
}

bool section(const Fonts& fonts, const char* title, bool openAtFirst) {
    ImGuiStorage* const storage = ImGui::GetStateStorage();
    const ImGuiID id = ImGui::GetID(title);
    bool open = storage->GetBool(id, openAtFirst);

    ImGui::Dummy({0.0f, 0.15f * em()});
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const float height = 2.0f * em();
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    draw->AddLine(at, {at.x + width, at.y}, packed(color::kLine));
    ImGui::PushID(title);
    if (ImGui::InvisibleButton("section", {width, height})) {
        open = !open;
        storage->SetBool(id, open);
    }
    ImGui::PopID();
    const bool hovered = ImGui::IsItemHovered();
    const ImU32 tint = packed(hovered ? color::kAccent : open ? color::kText : color::kDim);
    draw->AddText(fonts.strong, em(), {at.x, at.y + 0.5f * (height - em()) + 0.1f * em()}, tint,
                  title);

    const float s = 0.26f * em();
    const ImVec2 c{at.x + width - 2.0f * s, at.y + 0.55f * height};
    const ImU32 mark = packed(hovered ? color::kAccent : color::kFaint);
    const float thick = std::max(1.5f, 0.11f * em());
    if (open) {
        draw->AddLine({c.x - s, c.y - 0.5f * s}, {c.x, c.y + 0.5f * s}, mark, thick);
        draw->AddLine({c.x, c.y + 0.5f * s}, {c.x + s, c.y - 0.5f * s}, mark, thick);
    } else {
        draw->AddLine({c.x - 0.5f * s, c.y - s}, {c.x + 0.5f * s, c.y}, mark, thick);
        draw->AddLine({c.x + 0.5f * s, c.y}, {c.x - 0.5f * s, c.y + s}, mark, thick);
    }
    return open;
}

bool switchButton(const char* id, bool on) {
    const float height = ImGui::GetFrameHeight();
    const float track = 0.62f * height, width = 1.9f * track;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool turned = ImGui::InvisibleButton(id, {width, height});
    const bool hovered = ImGui::IsItemHovered();
    const ImVec2 low{at.x, at.y + 0.5f * (height - track)};
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    const ImVec4 ground = on ? (hovered ? color::kAccent : color::rgb(0xcf8a48))
                             : (hovered ? color::kFrameActive : color::kFrameHovered);
    draw->AddRectFilled(low, {low.x + width, low.y + track}, packed(ground), 0.5f * track);
    const float knob = 0.5f * track;
    draw->AddCircleFilled({on ? low.x + width - knob : low.x + knob, low.y + knob}, 0.72f * knob,
                          packed(on ? color::kOnAccent : color::kDim), 24);
    return turned;
}

bool litButton(const char* label, bool lit, float width) {
    ImGui::PushStyleColor(ImGuiCol_Button, lit ? color::rgb(0xcf8a48) : color::kFrame);
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, lit ? color::kAccent : color::kFrameHovered);
    ImGui::PushStyleColor(ImGuiCol_ButtonActive, lit ? color::kAccent : color::kFrameActive);
    ImGui::PushStyleColor(ImGuiCol_Text, lit ? color::kOnAccent : color::kText);
    const bool pressed = ImGui::Button(label, {width, 0.0f});
    ImGui::PopStyleColor(4);
    return pressed;
}

void keyCap(std::string_view keys) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float pad = 0.4f * em();
    const float height = 1.45f * em();
    const float width = std::max(widthOf(keys) + 2.0f * pad, height);
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled(at, {at.x + width, at.y + height}, packed(color::kFrame), 0.28f * em());
    draw->AddRect(at, {at.x + width, at.y + height}, packed(color::kFrameActive), 0.28f * em());
    draw->AddText({at.x + 0.5f * (width - widthOf(keys)), at.y + 0.5f * (height - em())},
                  packed(color::kText), keys.data(), keys.data() + keys.size());
    ImGui::Dummy({width, height});
}

void tooltip(const std::string& words) {
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
        return;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.8f * em(), 0.6f * em()});
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(24.0f * em());
    text(words);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
    ImGui::PopStyleVar();
}

bool clippedText(std::string_view words, float width) {
    if (widthOf(words) <= width) {
        text(words);
        return false;
    }
    std::string_view kept = words;
    while (!kept.empty() && widthOf(kept) + widthOf("...") > width)
        kept.remove_suffix(1);
    text(std::string(kept) + "...");
    return true;
}

void dimText(std::string_view words) {
    ImGui::PushStyleColor(ImGuiCol_Text, color::kDim);
    text(words);
    ImGui::PopStyleColor();
}

void dimWrapped(std::string_view words) {
    ImGui::PushTextWrapPos(0.0f);
    dimText(words);
    ImGui::PopTextWrapPos();
}

float labelColumn() {
    return 0.43f * ImGui::GetContentRegionAvail().x;
}

void rowLabel(std::string_view label) {
    const float column = labelColumn();
    const float begin = ImGui::GetCursorPosX();
    ImGui::AlignTextToFramePadding();
    clippedText(label, column - 0.4f * em());
    ImGui::SameLine(begin + column);
    ImGui::SetNextItemWidth(-1.0f);
}

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

void fieldRow(Settings& settings, const Field& field) {
    ImGui::PushID(field.key.data(), field.key.data() + field.key.size());
    // The heading of the group says what a label repeats in brackets.
    std::string_view label = field.label;
    if (const auto bracket = label.find(" ("); bracket != label.npos)
        label = label.substr(0, bracket);
    const float reset = 0.8f * ImGui::GetFrameHeight();
    const bool changed = !isDefault(settings, field);
    rowLabel(label);
    tooltip(helpOf(field));

    const double value = fieldValue(settings, field);
    ImGui::SetNextItemWidth(-reset - 0.3f * em());
    if (!field.choices.empty()) {
        const std::string_view now = field.choices[std::size_t(value)];
        if (ImGui::BeginCombo("##choice", std::string(now).c_str())) {
            for (std::size_t i = 0; i < field.choices.size(); ++i)
                if (ImGui::Selectable(std::string(field.choices[i]).c_str(), double(i) == value))
                    setFieldValue(settings, field, double(i));
            ImGui::EndCombo();
        }
    } else {
        double moved = value;
        if (slider("##value", moved, {field.min, field.max, field.logarithmic},
                   formatOf(field).c_str()))
            setFieldValue(settings, field, moved);
    }
    tooltip(helpOf(field));
    if (changed) {
        ImGui::SameLine(0.0f, 0.3f * em());
        if (resetButton("reset"))
            resetField(settings, field);
        tooltip("Back to " + valueText(field, fieldValue(Settings{}, field)));
    }
    ImGui::PopID();
}

} // namespace afterglow
