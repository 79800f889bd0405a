// What the picture shows, how large and how bright.

#include "app/ui/panels.h"
#include "app/ui/widgets.h"

#include <algorithm>
#include <cmath>

#include <imgui.h>

namespace afterglow {
namespace {

void chooseImage(ViewState& state) {
    rowLabel("Image");
    const char* now = state.image ? state.displays[*state.image].name.data() : "picture";
    if (ImGui::BeginCombo("##image", now, ImGuiComboFlags_HeightLarge)) {
        if (ImGui::Selectable("picture", !state.image))
            state.image.reset();
        tooltip("The denoised picture, tone-mapped");
        for (std::size_t i = 0; i < state.displays.size(); ++i) {
            const AovInfo& aov = aovs()[i];
            const bool made = isMadeBy(aov, state.settings.filter, state.settings.denoiser);
            ImGui::BeginDisabled(!made);
            if (ImGui::Selectable(std::string(aov.name).c_str(), state.image == i))
                state.image = i;
            ImGui::EndDisabled();
            tooltip(std::string(aov.meaning) + (made ? "" : "\nThis filter does not make it."));
        }
        ImGui::EndCombo();
    }
    tooltip("V goes through them, B returns to the picture. Names as in render --aov.");
}

void chooseRange(ViewState& state, ImageDisplay& display) {
    const int ends = rangeEnds(display.map);
    if (ends == 0)
        return;
    rowLabel("Range");
    const float fit = 3.2f * ImGui::GetFontSize();
    ImGui::SetNextItemWidth(-fit - 0.4f * ImGui::GetFontSize());
    const float step = std::max(std::abs(display.high), 1e-6f) * 0.01f;
    if (ends == 2) {
        const float least = display.map == gpu::kMapLogarithm ? 1e-9f : -1e9f;
        ImGui::DragFloatRange2("##range", &display.low, &display.high, step, least, 1e9f, "%.3g",
                               "%.3g", ImGuiSliderFlags_AlwaysClamp);
    } else {
        ImGui::DragFloat("##high", &display.high, step, 1e-6f, 1e9f, "%.3g",
                         ImGuiSliderFlags_AlwaysClamp);
        if (display.map == gpu::kMapSigned)
            display.low = -display.high;
    }
    tooltip("Drag, or ctrl-click to type. Values outside have the color of the end.");
    ImGui::SameLine(0.0f, 0.4f * ImGui::GetFontSize());
    if (litButton("Fit", false, fit))
        state.fitRangeWanted = true;
    tooltip("Fits the range to this frame: all but the outermost hundredth");
}

} // namespace

void panelView(const PanelContext& panel) {
    if (!section(panel.fonts, "View", true))
        return;
    ViewState& state = panel.state;
    chooseImage(state);
    if (const auto shown = shownImage(state))
        chooseRange(state, state.displays[*shown]);
    else
        for (const Field& field : fields())
            if (field.group == "display")
                fieldRow(state.settings, field);

    rowLabel("Resolution");
    const auto choices = resolutions();
    const auto now = std::ranges::find(choices, state.resolution, &NamedResolution::resolution);
    const std::string other = std::to_string(state.resolution.fixed.x) + " \xc3\x97 " +
                              std::to_string(state.resolution.fixed.y);
    if (ImGui::BeginCombo("##resolution", now == choices.end() ? other.c_str() : now->name.data(),
                          ImGuiComboFlags_HeightLarge)) {
        for (const auto& [name, resolution] : choices)
            if (ImGui::Selectable(name.data(), resolution == state.resolution))
                state.resolution = resolution;
        ImGui::EndCombo();
    }
    tooltip("+ and -. Pixels that are rendered. A fixed size is scaled into the window with its "
            "proportions "
            "kept; software rendering starts with 640 \xc3\x97 360 so that it stays quick. Another "
            "size "
            "clears the history.");
    rowLabel("Smooth scaling");
    if (switchButton("smooth", state.smoothScaling))
        state.smoothScaling = !state.smoothScaling;
    tooltip("Off: every rendered pixel is a sharp square");
}

} // namespace afterglow
