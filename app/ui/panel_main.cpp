// Filter, lights, and time and camera.

#include "app/ui/panels.h"
#include "app/ui/widgets.h"

#include <algorithm>
#include <cstdio>

#include <imgui.h>

namespace afterglow {
namespace {

constexpr double kMostPower = 4.0; // in multiples of the scene's

float em() {
    return ImGui::GetFontSize();
}

// 197202 as "197 202".
std::string grouped(std::size_t number) {
    std::string digits = std::to_string(number);
    for (int at = int(digits.size()) - 3; at > 0; at -= 3)
        digits.insert(std::size_t(at), " ");
    return digits;
}

// Width of each of `count` things beside each other.
float shareOf(int count, float gap) {
    return (ImGui::GetContentRegionAvail().x - gap * float(count - 1)) / float(count);
}

} // namespace

const char* titleOf(Filter filter) {
    switch (filter) {
    case Filter::None: return "None";
    case Filter::Fixed: return "Fixed \xce\xb1";
    case Filter::Svgf: return "SVGF";
    case Filter::Asvgf: return "A-SVGF";
    case Filter::Clamp: return "Clamp";
    case Filter::Percentile: return "Percentile";
    case Filter::Confidence: return "Confidence";
    }
    return "";
}

void panelHeader(const PanelContext& panel) {
    ImGui::PushFont(panel.fonts.large);
    ImGui::PushStyleColor(ImGuiCol_Text, color::kAccent);
    ImGui::TextUnformatted("Afterglow");
    ImGui::PopStyleColor();
    ImGui::PopFont();
    ImGui::SameLine();
    const float help = 2.4f * em();
    ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - help);
    if (litButton("F1", panel.state.showHelp, help))
        perform(panel.state, {Action::ToggleHelp});
    tooltip("All keys");

    const SceneStats& stats = panel.frame.sceneStats;
    const std::size_t lights = panel.state.lights.size();
    dimText(panel.frame.scene.name + ": " + grouped(stats.triangles) + " triangles, " +
            std::to_string(lights) + (lights == 1 ? " light" : " lights"));
    char more[400];
    std::snprintf(more, sizeof more,
                  "%zu instances\n%zu nodes of the bounding volume hierarchy, built in %.1f ms\n"
                  "%.1f MiB of images\n%s\nOpenGL %s",
                  stats.instances, stats.bvhNodes, stats.bvhBuildMilliseconds,
                  double(panel.frame.imageBytes) / (1024.0 * 1024.0),
                  panel.frame.gl.renderer.c_str(), panel.frame.gl.version.c_str());
    tooltip(more);
    ImGui::Dummy({0.0f, 0.1f * em()});
}

void panelFilter(const PanelContext& panel) {
    if (!section(panel.fonts, "Filter", true))
        return;
    ViewState& state = panel.state;
    const float gap = 0.3f * em();
    constexpr int kInRow = 4;
    const float width = shareOf(kInRow, gap);
    int place = 0;
    for (const Filter filter : allFilters()) {
        if (place++ % kInRow != 0)
            ImGui::SameLine(0.0f, gap);
        if (litButton(titleOf(filter), state.settings.filter == filter, width))
            chooseFilter(state, filter);
        tooltip(std::string(describe(filter)));
    }
    ImGui::PushFont(panel.fonts.small);
    dimWrapped(describe(state.settings.filter));
    ImGui::PopFont();

    const float third = shareOf(3, gap);
    if (litButton(state.paused ? "Resume" : "Pause", state.paused, third))
        togglePause(state);
    tooltip("P or space. While paused nothing is rendered: changes show with the next step.");
    ImGui::SameLine(0.0f, gap);
    if (litButton("Step", false, third))
        stepOnce(state);
    tooltip("N. Renders one frame, then pauses.");
    ImGui::SameLine(0.0f, gap);
    if (litButton("Forget history", false, third))
        perform(state, {Action::ResetHistory});
    tooltip("H. The next frame starts from nothing, as after a cut.");
}

void panelLights(const PanelContext& panel) {
    if (!section(panel.fonts, "Lights", true))
        return;
    ViewState& state = panel.state;
    for (std::size_t slot = 0; slot < state.lights.size(); ++slot) {
        LightState& light = state.lights[slot];
        ImGui::PushID(int(slot));
        if (switchButton("on", light.on))
            toggleLight(state, slot);
        const std::string key = slot < 9 ? "Key " + std::to_string(slot + 1) : std::string();
        tooltip(key.empty() ? "On or off" : key + (state.lightNames[slot] == "key" ? " or L" : ""));
        ImGui::SameLine(0.0f, 0.6f * em());
        ImGui::AlignTextToFramePadding();
        const float name = 0.36f * ImGui::GetContentRegionAvail().x;
        const float begin = ImGui::GetCursorPosX();
        if (clippedText(state.lightNames[slot], name))
            tooltip(state.lightNames[slot]);
        ImGui::SameLine(begin + name + 0.4f * em());
        ImGui::SetNextItemWidth(-3.5f * em());
        ImGui::BeginDisabled(!light.on);
        double power = light.power;
        if (slider("##power", power, {0.0, kMostPower}, "%.2f \xc3\x97"))
            light.power = float(power);
        tooltip("Radiance, in multiples of the scene's. Ctrl-click to type.");
        ImGui::SameLine(0.0f, 0.4f * em());
        ImGui::ColorEdit3("##tint", &light.tint.x,
                          ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_Float |
                              ImGuiColorEditFlags_NoTooltip);
        tooltip("Tint of this light, linear");
        ImGui::EndDisabled();
        if (light.power != 1.0f || light.tint != glm::vec3(1.0f)) {
            ImGui::SameLine(0.0f, 0.3f * em());
            if (resetButton("reset"))
                light = {.on = light.on};
            tooltip("As the scene has it");
        }
        ImGui::PopID();
    }
    if (state.lights.empty())
        dimText("This scene has none.");
}

void panelMotion(const PanelContext& panel) {
    if (!section(panel.fonts, "Time and camera", false))
        return;
    ViewState& state = panel.state;
    rowLabel("Movement");
    ImGui::BeginDisabled(!state.isAnimated);
    if (switchButton("animate", state.animate && state.isAnimated))
        toggleAnimation(state);
    ImGui::EndDisabled();
    tooltip(state.isAnimated ? "M. Plays the scene's own animation."
                             : "Nothing moves in this scene.");

    rowLabel("Time step");
    int step = int(state.timeStep);
    if (ImGui::Combo("##step", &step, "1/60 s a frame\0wall clock\0"))
        state.timeStep = TimeStep(step);
    tooltip("How far scene time goes from frame to frame. With a fixed step a run can be repeated "
            "exactly.");

    if (state.cameraNames.size() > 1) {
        rowLabel("Camera");
        if (ImGui::BeginCombo("##camera", state.cameraNames[state.cameraIndex].c_str())) {
            for (std::size_t i = 0; i < state.cameraNames.size(); ++i)
                if (ImGui::Selectable(state.cameraNames[i].c_str(), i == state.cameraIndex))
                    chooseCamera(state, panel.frame.scene, i);
            ImGui::EndCombo();
        }
    }
    rowLabel("Flying speed");
    const double standard = defaultSpeed(state.extent);
    double speed = state.speed;
    if (slider("##speed", speed, {standard / 50.0, standard * 50.0, true}, "%.3g m/s"))
        state.speed = float(speed);
    tooltip("The wheel changes it; Shift is four times as fast.");
    const glm::vec3 eye = state.camera.position;
    char where[96];
    std::snprintf(where, sizeof where, "%.2f  %.2f  %.2f m", eye.x, eye.y, eye.z);
    rowLabel("Position");
    dimText(where);
    if (litButton("Back to the scene's camera", false, ImGui::GetContentRegionAvail().x))
        goHome(state);
    tooltip("R or Home");
}

} // namespace afterglow
