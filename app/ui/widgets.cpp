// SPDX-License-Identifier: MIT
#include "app/ui/widgets.h"

#include "app/ui/draw.h"

#include <algorithm>
#include <cmath>

namespace afterglow {
namespace {

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

ImVec4 brighter(ImVec4 c) {
    const auto up = [](float x) { return x + 0.25f * (1.0f - x); };
    return {up(c.x), up(c.y), up(c.z), c.w};
}

bool coloredButton(const char* label, float width, ImVec4 ground, ImVec4 hovered, ImVec4 words) {
    ImGui::PushStyleColor(ImGuiCol_Button, ground);
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, hovered);
    ImGui::PushStyleColor(ImGuiCol_ButtonActive, hovered);
    ImGui::PushStyleColor(ImGuiCol_Text, words);
    const bool pressed = ImGui::Button(label, {width, 0.0f});
    ImGui::PopStyleColor(4);
    return pressed;
}

} // namespace

void focusRing() {
    if (!ImGui::IsItemFocused() || !ImGui::GetIO().NavVisible)
        return;
    ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    low = {low.x - 1.0f, low.y - 1.0f};
    high = {high.x + 1.0f, high.y + 1.0f};
    ImGui::GetWindowDrawList()->AddRect(low, high, packed(color::kAccent),
                                        ImGui::GetStyle().FrameRounding, 0, 1.5f);
}

ImVec2 middleBeside(float panelEnd, float width) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float left = screen.x - panelEnd >= width ? panelEnd : 0.0f;
    return {0.5f * (left + screen.x), 0.5f * screen.y};
}

float shareOf(int count, float gap) {
    return (ImGui::GetContentRegionAvail().x - gap * float(count - 1)) / float(count);
}

bool resetButton(const char* id) {
    const float size = ImGui::GetFrameHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool pressed = ImGui::InvisibleButton(id, {size * 0.8f, size});
    focusRing();
    drawResetIcon({at.x + size * 0.42f, at.y + size * 0.5f}, size * 0.23f,
                  packed(ImGui::IsItemHovered() ? color::kAccent : color::kDim));
    return pressed;
}

bool section(const Fonts& fonts, const char* title, bool openAtFirst, std::string_view note,
             ImVec4 noteColor) {
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
    focusRing();
    const bool hovered = ImGui::IsItemHovered();
    const ImU32 tint = packed(hovered ? color::kAccent : open ? color::kText : color::kDim);
    const float y = at.y + 0.5f * (height - em()) + 0.1f * em();
    draw->AddText(fonts.strong, em(), {at.x, y}, tint, title);
    if (!note.empty()) {
        const float x = fonts.strong->CalcTextSizeA(em(), 1e9f, 0.0f, title).x + 0.7f * em();
        const std::string words = clipped(note, width - x - 2.0f * em());
        draw->AddText({at.x + x, y}, packed(noteColor), words.c_str());
    }

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

void groupTitle(const Fonts& fonts, const char* title) {
    write(title, color::kAccent, fonts.small);
}

bool switchButton(const char* id, bool on) {
    const float height = ImGui::GetFrameHeight();
    const float track = 0.62f * height, width = 1.9f * track;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool turned = ImGui::InvisibleButton(id, {width, height});
    focusRing();
    const bool hovered = ImGui::IsItemHovered();
    const ImVec2 low{at.x, at.y + 0.5f * (height - track)};
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    const ImVec4 ground = on ? (hovered ? color::kAccent : color::kLit)
                             : (hovered ? color::kFrameActive : color::kFrameHovered);
    draw->AddRectFilled(low, {low.x + width, low.y + track}, packed(ground), 0.5f * track);
    const float knob = 0.5f * track;
    draw->AddCircleFilled({on ? low.x + width - knob : low.x + knob, low.y + knob}, 0.72f * knob,
                          packed(on ? color::kOnAccent : color::kDim), 24);
    return turned;
}

bool litButton(const char* label, bool lit, float width, ImVec4 tint) {
    return coloredButton(label, width, lit ? tint : color::kFrame,
                         lit ? brighter(tint) : color::kFrameHovered,
                         lit ? color::kOnAccent : color::kText);
}

bool quietButton(const char* label, bool lit, float width) {
    return coloredButton(label, width, lit ? color::kFill : color::kFrame,
                         lit ? color::rgb(0x654d33) : color::kFrameHovered,
                         lit ? color::kOnFill : color::kText);
}

void actionButton(ViewState& state, KeyStroke stroke, float width, ButtonStyle style) {
    const Action& action = *actionOf(stroke);
    const bool lit = action.isLit && action.isLit(state);
    ImGui::PushID(&action);
    ImGui::BeginDisabled(action.isPossible && !action.isPossible(state));
    if (style == ButtonStyle::Quiet
            ? quietButton(action.label, lit, width)
            : litButton(action.label, lit, width, action.records ? color::kRecording : color::kLit))
        action.perform(state);
    ImGui::EndDisabled();
    ImGui::PopID();
    tooltip(tipOf(action));
}

void actionRow(ViewState& state, std::initializer_list<KeyStroke> strokes, float width,
               ButtonStyle style) {
    const float gap = 0.3f * em(), count = float(strokes.size());
    for (const KeyStroke& stroke : strokes) {
        if (&stroke != strokes.begin())
            ImGui::SameLine(0.0f, gap);
        actionButton(state, stroke, (width - gap * (count - 1.0f)) / count, style);
    }
}

std::optional<int> segments(const char* label, std::span<const char* const> names, int lit,
                            const std::string& tip) {
    rowLabel(label);
    const float gap = 0.25f * em();
    const float width = shareOf(int(names.size()), gap);
    std::optional<int> pressed;
    ImGui::PushID(label);
    ImGui::BeginGroup();
    for (int i = 0; i < int(names.size()); ++i) {
        if (i > 0)
            ImGui::SameLine(0.0f, gap);
        if (quietButton(names[std::size_t(i)], i == lit, width))
            pressed = i;
    }
    ImGui::EndGroup();
    ImGui::PopID();
    tooltip(tip);
    return pressed;
}

bool switchRow(const char* label, bool on, const std::string& tip) {
    rowLabel(label);
    const bool turned = switchButton(label, on);
    tooltip(tip);
    return turned;
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
    if (ImGui::IsItemActive() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
        return;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.8f * em(), 0.6f * em()});
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(24.0f * em());
    write(words);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
    ImGui::PopStyleVar();
}

bool clippedText(std::string_view words, float width) {
    const std::string shown = clipped(words, width);
    ImGui::TextUnformatted(shown.c_str());
    return shown != words;
}

void write(std::string_view words, ImVec4 tint, ImFont* font) {
    const WithFont letters(font ? font : ImGui::GetFont());
    ImGui::PushStyleColor(ImGuiCol_Text, tint);
    ImGui::TextUnformatted(words.data(), words.data() + words.size());
    ImGui::PopStyleColor();
}

void dimText(std::string_view words, ImFont* font) {
    write(words, color::kDim, font);
}

void dimWrapped(std::string_view words, ImFont* font) {
    ImGui::PushTextWrapPos(0.0f);
    dimText(words, font);
    ImGui::PopTextWrapPos();
}

Overlay::Overlay(const char* name, const OverlayLook& look) {
    ImGui::SetNextWindowBgAlpha(look.alpha);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, look.rounding * em());
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, look.hasBorder ? 1.0f : 0.0f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                        {look.padding.x * em(), look.padding.y * em()});
    ImGui::Begin(name, nullptr,
                 look.more | ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings);
}

Overlay::~Overlay() {
    ImGui::End();
    ImGui::PopStyleVar(3);
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

} // namespace afterglow
