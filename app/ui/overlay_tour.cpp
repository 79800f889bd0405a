// SPDX-License-Identifier: MIT
// The card of the guided tour.

#include "app/ui/draw.h"
#include "app/ui/panels.h"
#include "app/ui/widgets.h"

#include <algorithm>

#include <imgui.h>

namespace afterglow {
namespace {

// em
constexpr float kWidth = 26.0f, kAboveStatus = 2.9f, kPaddingX = 1.1f, kPaddingY = 0.9f;

// One for each stop; a click goes there.
void dots(ViewState& state, std::size_t count, float width) {
    const float step = std::min(1.1f * em(), width / float(count));
    const float height = 1.0f * em(), radius = 0.24f * em();
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0)
            ImGui::SameLine(0.0f, 0.0f);
        ImGui::PushID(int(i));
        const ImVec2 at = ImGui::GetCursorScreenPos();
        if (ImGui::InvisibleButton("dot", {step, height}))
            state.wanted.tourStop = i;
        focusRing();
        const bool here = i == *state.tourStop, hovered = ImGui::IsItemHovered();
        ImGui::GetWindowDrawList()->AddCircleFilled(
            {at.x + 0.5f * step, at.y + 0.5f * height}, here ? 1.25f * radius : radius,
            packed(here || hovered       ? color::kAccent
                   : i < *state.tourStop ? color::kDim
                                         : color::kFrameActive),
            20);
        ImGui::PopID();
    }
}

void buttons(ViewState& state, std::size_t count) {
    const std::size_t stop = *state.tourStop;
    const float gap = 0.4f * em(), width = 5.6f * em();
    if (litButton("Leave", false, 4.4f * em()))
        press(state, {Key::F6});
    tooltip("Esc or F6. All stays as the tour has set it.");
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - 2.0f * width - gap);
    ImGui::BeginDisabled(stop == 0);
    if (litButton("Previous", false, width))
        press(state, {Key::PageUp});
    ImGui::EndDisabled();
    tooltip("Page up");
    ImGui::SameLine(0.0f, gap);
    const bool last = stop + 1 >= count;
    if (litButton(last ? "Done###next" : "Next###next", true, width))
        press(state, {Key::PageDown});
    tooltip(last ? "Page down. The tour ends here." : "Page down");
}

// What the card takes, before it has been drawn.
ImVec2 cardSize(const PanelContext& panel, const TourStop& stop, float width) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float text =
        ImGui::CalcTextSize(stop.text.c_str(), nullptr, false, width - 2.0f * kPaddingX * em()).y;
    const float lines = panel.fonts.small->FontSize / panel.fonts.text->FontSize + 2.1f;
    return {width, 2.0f * kPaddingY * em() + text + lines * em() + ImGui::GetFrameHeight() +
                       5.0f * style.ItemSpacing.y};
}

bool coversProbe(const PanelContext& panel, ImVec2 low, ImVec2 size) {
    const glm::ivec2 image = panel.bench.imageSize();
    if (image.x <= 0 || image.y <= 0)
        return false;
    for (const auto& placed : panel.state.probes)
        for (const PanePlace& place : panel.frame.places) {
            if (!placed)
                continue;
            const UiRect box = inUnits(panel, place, rescaled(placed->probe, placed->image, image));
            const ImVec2 from = box.min, to = box.end();
            if (from.x < low.x + size.x && to.x > low.x && from.y < low.y + size.y && to.y > low.y)
                return true;
        }
    return false;
}

// In the first of the corners where it hides no probe: what is measured is to be seen.
ImVec2 cardPlace(const PanelContext& panel, const UiRect& view, ImVec2 size) {
    const float left = view.min.x + em(), right = view.end().x - em() - size.x;
    const float top = view.min.y + em(), bottom = view.end().y - kAboveStatus * em() - size.y;
    for (const ImVec2 corner :
         {ImVec2(right, top), ImVec2(left, bottom), ImVec2(right, bottom), ImVec2(left, top)})
        if (corner.y >= view.min.y && !coversProbe(panel, corner, size))
            return corner;
    return {right, top};
}

} // namespace

void overlayTour(const PanelContext& panel) {
    ViewState& state = panel.state;
    const std::vector<TourStop>& stops = tourStops();
    if (!state.tourStop || *state.tourStop >= stops.size())
        return;
    const TourStop& stop = stops[*state.tourStop];
    const UiRect view = inUnits(panel, panel.frame.layout.view);
    const float room = view.size.x - 2.0f * em();
    if (room < 12.0f * em())
        return;
    const ImVec2 size = cardSize(panel, stop, std::min(kWidth * em(), room));
    ImGui::SetNextWindowPos(cardPlace(panel, view, size));
    ImGui::SetNextWindowSize({size.x, 0.0f});
    const Overlay window(
        "tour", {.alpha = 0.94f,
                 .padding = {kPaddingX, kPaddingY},
                 .rounding = 0.6f,
                 .more = ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_AlwaysAutoResize});
    dimText(std::to_string(*state.tourStop + 1) + " of " + std::to_string(stops.size()),
            panel.fonts.small);
    ImGui::PushTextWrapPos(0.0f);
    write(stop.title, color::kAccent, panel.fonts.strong);
    write(stop.text);
    ImGui::PopTextWrapPos();
    ImGui::Dummy({0.0f, 0.1f * em()});
    dots(state, stops.size(), ImGui::GetContentRegionAvail().x);
    buttons(state, stops.size());
}

} // namespace afterglow
