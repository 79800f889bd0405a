// SPDX-License-Identifier: MIT
// The lights, and what can happen in the scene at a press.

#include "app/ui/draw.h"
#include "app/ui/panels.h"
#include "app/ui/widgets.h"

#include <algorithm>

#include <imgui.h>

namespace afterglow {
namespace {

constexpr double kMostPower = 4.0; // in multiples of the scene's
constexpr int kMostFrames = 9999;

std::string keyHint(const ViewState& state, std::size_t slot, const char* with) {
    if (slot >= 9)
        return {};
    std::string key = with + std::to_string(slot + 1);
    if (*with == 0 && state.lightNames[slot] == "key")
        key += " or L";
    return key + ". ";
}

// The hue to which a light is changed, as a dot on the button before it.
void colorDot(glm::vec3 tint) {
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    const float most = std::max({tint.r, tint.g, tint.b, 1e-6f});
    const ImVec4 shown{tint.r / most, tint.g / most, tint.b / most, 1.0f};
    ImGui::GetWindowDrawList()->AddCircleFilled({0.5f * (low.x + high.x), 0.5f * (low.y + high.y)},
                                                0.3f * em(), packed(shown), 20);
}

void lightRow(ViewState& state, std::size_t slot) {
    LightState& light = state.lights[slot];
    const float gap = 0.35f * em(), small = 1.6f * em(), reset = 0.8f * ImGui::GetFrameHeight();
    if (switchButton("on", light.on))
        toggleLight(state, slot);
    tooltip(keyHint(state, slot, "") + "On or off.");
    ImGui::SameLine(0.0f, 0.5f * em());
    ImGui::AlignTextToFramePadding();
    const float tail = 3.0f * (small + gap) + reset + gap;
    const float name = 0.52f * (ImGui::GetContentRegionAvail().x - tail);
    const float begin = ImGui::GetCursorPosX();
    if (clippedText(state.lightNames[slot], name))
        tooltip(state.lightNames[slot]);
    ImGui::SameLine(begin + name + gap);
    ImGui::SetNextItemWidth(-tail);
    ImGui::BeginDisabled(!light.on);
    double power = light.power;
    if (slider("##power", power, {0.0, kMostPower}, "%.2f \xc3\x97"))
        light.power = float(power);
    tooltip("Radiance, in multiples of the scene's. Ctrl-click to type.");
    ImGui::SameLine(0.0f, gap);
    if (quietButton("\xc2\xbd", light.power == 0.5f, small))
        letHappen(state, {EventKind::Dim, slot});
    tooltip(keyHint(state, slot, "Shift ") + "To half its power, and back.");
    ImGui::SameLine(0.0f, gap);
    const bool tinted = light.tint != glm::vec3(1.0f);
    if (quietButton("##color", tinted, small))
        letHappen(state, {EventKind::Recolor, slot});
    colorDot(equalLuminanceTint(state.lightColors[slot]) * state.lightColors[slot]);
    tooltip(keyHint(state, slot, "Ctrl ") +
            "To another color of the same luminance, and back: a change that a gradient of "
            "luminance cannot see.");
    ImGui::SameLine(0.0f, gap);
    ImGui::ColorEdit3("##tint", &light.tint.x,
                      ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_Float |
                          ImGuiColorEditFlags_HDR | ImGuiColorEditFlags_NoTooltip);
    tooltip("Tint of this light: what it emits is multiplied by it. Linear.");
    ImGui::EndDisabled();
    if (light.power != 1.0f || tinted) {
        ImGui::SameLine(0.0f, gap);
        if (resetButton("reset"))
            light = {.on = light.on};
        tooltip("As the scene has it");
    }
}

void repeatRow(ViewState& state) {
    const bool repeats = state.time.repeat.every > 0;
    if (switchButton("repeat", repeats))
        toggleRepeat(state);
    const std::string name = nameOf(state.repeated, state.lightNames);
    tooltip("Y. Lets the last event happen again and again: " + name + ".");
    ImGui::SameLine(0.0f, 0.5f * em());
    ImGui::AlignTextToFramePadding();
    const float number = 3.6f * em();
    const float tail =
        ImGui::CalcTextSize("every").x + ImGui::CalcTextSize("frames").x + number + 1.2f * em();
    clippedText("Repeat: " + name, ImGui::GetContentRegionAvail().x - tail);
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - tail + 0.4f * em());
    dimText("every");
    ImGui::SameLine(0.0f, 0.4f * em());
    ImGui::SetNextItemWidth(number);
    if (ImGui::DragInt("##every", &state.repeatEvery, 0.5f, 1, kMostFrames, "%d",
                       ImGuiSliderFlags_AlwaysClamp) &&
        repeats)
        state.time.repeat.every = state.repeatEvery;
    tooltip("Drag, or ctrl-click to type.");
    ImGui::SameLine(0.0f, 0.4f * em());
    dimText("frames");
}

} // namespace

void panelLights(const PanelContext& panel) {
    ViewState& state = panel.state;
    const bool played = state.time.playing.has_value();
    if (!section(panel.fonts, "Lights and events", true, played ? "as the take has them" : ""))
        return;
    ImGui::BeginDisabled(played);
    for (std::size_t slot = 0; slot < state.lights.size(); ++slot) {
        ImGui::PushID(int(slot));
        lightRow(state, slot);
        ImGui::PopID();
    }
    if (state.lights.empty())
        dimText("This scene has none.");
    actionRow(state, {plain('C'), shift('C'), plain('M')}, ImGui::GetContentRegionAvail().x,
              ButtonStyle::Quiet);
    ImGui::EndDisabled();
    repeatRow(state);
}

} // namespace afterglow
