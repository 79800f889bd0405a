// SPDX-License-Identifier: MIT
// From where the scene is seen.

#include "app/ui/draw.h"
#include "app/ui/panels.h"
#include "app/ui/widgets.h"

#include <ranges>

#include <fmt/format.h>
#include <imgui.h>

namespace afterglow {
namespace {

void chooseSceneCamera(const PanelContext& panel) {
    ViewState& state = panel.state;
    if (state.cameraNames.size() < 2)
        return;
    std::size_t index = state.cameraIndex;
    const auto nameOf = [&](std::size_t i) { return state.cameraNames[i]; };
    if (chooseRow("Camera", index, std::views::iota(std::size_t(0), state.cameraNames.size()),
                  nameOf, "The scene's own cameras"))
        chooseCamera(state, panel.bench.scene(), index);
}

void drawCross(ImU32 tint) {
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    const ImVec2 c{0.5f * (low.x + high.x), 0.5f * (low.y + high.y)};
    const float s = 0.25f * em(), line = 0.11f * em();
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    draw->AddLine({c.x - s, c.y - s}, {c.x + s, c.y + s}, tint, line);
    draw->AddLine({c.x - s, c.y + s}, {c.x + s, c.y - s}, tint, line);
}

void places(ViewState& state) {
    auto& remembered = bookmarks(state);
    std::size_t forgotten = remembered.size();
    const float cross = ImGui::GetFrameHeight(), gap = 0.3f * em();
    for (std::size_t i = 0; i < remembered.size(); ++i) {
        ImGui::PushID(int(i));
        if (litButton(remembered[i].name.c_str(), false,
                      ImGui::GetContentRegionAvail().x - cross - gap))
            goToBookmark(state, i);
        tooltip("Ctrl Shift " + std::to_string(i + 1) + ". Goes there at once.");
        ImGui::SameLine(0.0f, gap);
        if (ImGui::InvisibleButton("forget", {cross, cross}))
            forgotten = i;
        focusRing();
        drawCross(packed(ImGui::IsItemHovered() ? color::kAccent : color::kDim));
        tooltip("Forgets this place");
        ImGui::PopID();
    }
    if (forgotten < remembered.size())
        remembered.erase(remembered.begin() + std::ptrdiff_t(forgotten));
    actionButton(state, control('B'), ImGui::GetContentRegionAvail().x);
}

} // namespace

void panelCamera(const PanelContext& panel) {
    ViewState& state = panel.state;
    if (!section(panel.fonts, "Camera", false, state.onPath ? "on its path" : "", color::kAccent))
        return;
    chooseSceneCamera(panel);
    rowLabel("Flying speed");
    const double standard = defaultSpeed(state.extent);
    double speed = state.speed;
    if (slider("##speed", speed, {standard / 50.0, standard * 50.0, true}, "%.3g m/s"))
        state.speed = float(speed);
    tooltip("The wheel changes it; Shift is four times as fast. W A S D, Q and E fly.");
    if (switchRow("Path", state.onPath, tipOf(*actionOf(shift('C')))))
        press(state, shift('C'));
    const glm::vec3 eye = state.camera.position;
    rowLabel("Position");
    dimText(fmt::format("{:.2f}  {:.2f}  {:.2f} m", eye.x, eye.y, eye.z));
    places(state);
    actionButton(state, plain('R'), ImGui::GetContentRegionAvail().x);
}

} // namespace afterglow
