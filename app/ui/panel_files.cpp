// SPDX-License-Identifier: MIT
// What is read and written: scenes, experiments, pictures, curves.

#include "app/ui/draw.h"
#include "app/ui/panels.h"
#include "app/ui/widgets.h"

#include "app/scenario/experiment.h"
#include "renderer/scene/procedural.h"

#include <string>

#include <imgui.h>
#include <imgui_stdlib.h>

namespace afterglow {
namespace {

void knownFiles(const PanelContext& panel) {
    ViewState& state = panel.state;
    const auto offer = [&](const std::string& shown, const std::string& name,
                           const std::string& help) {
        if (ImGui::Selectable(shown.c_str(), name == state.sceneName))
            state.wanted.open = name;
        tooltip(help);
    };
    groupTitle(panel.fonts, "Scenes");
    for (const SceneInfo& scene : proceduralScenes())
        offer(std::string(scene.name), std::string(scene.name), std::string(scene.description));
    groupTitle(panel.fonts, "Experiments");
    static const auto experiments = builtInExperiments();
    for (const ExperimentInfo& experiment : experiments)
        offer(experiment.name, experiment.name, experiment.description);
    if (!state.preferences.recentFiles.empty())
        groupTitle(panel.fonts, "Opened before");
    int number = 0;
    for (const std::filesystem::path& file : state.preferences.recentFiles) {
        ImGui::PushID(number++);
        offer(file.filename().string(), file.string(), file.string());
        ImGui::PopID();
    }
}

void openRows(const PanelContext& panel) {
    ViewState& state = panel.state;
    rowLabel("Open");
    const std::string now =
        clipped(state.sceneName, ImGui::GetContentRegionAvail().x - 3.0f * em());
    if (ImGui::BeginCombo("##known", now.c_str(), ImGuiComboFlags_HeightLargest)) {
        knownFiles(panel);
        ImGui::EndCombo();
    }
    tooltip("A scene, or an experiment, whose events then play. A file can also be dropped on the "
            "window.");
    rowLabel("From a file");
    static std::string typed; // and not opened yet
    const float button = 3.6f * em(), gap = 0.3f * em();
    ImGui::SetNextItemWidth(-button - gap);
    bool open = ImGui::InputTextWithHint("##file", "path", &typed,
                                         ImGuiInputTextFlags_EnterReturnsTrue |
                                             ImGuiInputTextFlags_AutoSelectAll);
    tooltip("The path or the name of a scene (.gltf, .glb) or of an experiment (.json). Return "
            "opens it.");
    ImGui::SameLine(0.0f, gap);
    ImGui::BeginDisabled(typed.empty());
    open |= litButton("Open", false, button);
    ImGui::EndDisabled();
    if (open && !typed.empty())
        state.wanted.open = typed;
}

void saveButtons(ViewState& state) {
    const auto row = [&](std::initializer_list<KeyStroke> strokes) {
        actionRow(state, strokes, ImGui::GetContentRegionAvail().x, ButtonStyle::Quiet);
    };
    row({{Key::F12}, {.key = Key::F12, .shift = true}, {.key = Key::F12, .control = true}});
    rowLabel("Curves");
    row({control('C'), control('E')});
}

void recordRow(const PanelContext& panel) {
    ViewState& state = panel.state;
    const FrameRecorder& recorder = panel.bench.recorder();
    const bool records = recorder.isRecording();
    std::string label = "Record frames";
    if (records) {
        label = "Stop, " + std::to_string(recorder.framesWritten()) + " written";
        if (const auto left = recorder.framesLeft())
            label += ", " + std::to_string(*left) + " left";
    }
    label += "###record";
    if (litButton(label.c_str(), records, ImGui::GetContentRegionAvail().x, color::kRecording))
        press(state, {Key::F9});
    tooltip(tipOf(*actionOf({Key::F9})));
    rowLabel("Ends after");
    ImGui::DragInt("##frames", &state.recordFrames, 0.5f, 0, 100000,
                   state.recordFrames > 0 ? "%d frames" : "when it is told to",
                   ImGuiSliderFlags_AlwaysClamp);
    tooltip("Frames of the next recording. Drag, or ctrl-click to type; 0: until F9 is pressed "
            "again.");
    if (recorder.isEncoding()) {
        dimText("ffmpeg makes a film of the frames ...", panel.fonts.small);
    }
}

} // namespace

void panelFiles(const PanelContext& panel) {
    const FrameRecorder& recorder = panel.bench.recorder();
    const char* const note = recorder.isRecording()  ? "recording frames"
                             : recorder.isEncoding() ? "making a film"
                                                     : "";
    if (!section(panel.fonts, "Files", false, note, color::kRecording))
        return;
    openRows(panel);
    saveButtons(panel.state);
    recordRow(panel);
    dimWrapped("What is saved goes into the folder in which the program was started; a message "
               "tells its name.",
               panel.fonts.small);
    ImGui::Dummy({0.0f, 0.5f * em()});
}

} // namespace afterglow
