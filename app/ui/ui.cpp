// SPDX-License-Identifier: MIT
#include "app/ui/ui.h"

#include "app/ui/draw.h"
#include "app/ui/panels.h"

#include <algorithm>
#include <cmath>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

namespace afterglow {
namespace {

// Units of the design.
constexpr float kPanelWidth = 372.0f, kSideWidth = 348.0f;
constexpr float kCurvesHeight = 224.0f, kStripHeight = 58.0f;

// Dear ImGui expects the clip space that OpenGL has from the start.
class ClipControl {
public:
    ClipControl() { glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE); }
    ~ClipControl() { glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE); }
    ClipControl(const ClipControl&) = delete;
    ClipControl& operator=(const ClipControl&) = delete;
};

constexpr ImGuiWindowFlags kDocked = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoSavedSettings |
                                     ImGuiWindowFlags_NoBringToFrontOnFocus;

/// A window that fills a part of the layout. Its contents are drawn if it is shown.
template <class Contents>
void docked(const PanelContext& panel, const char* name, const Rect& where, Contents contents) {
    if (where.empty())
        return;
    const UiRect rect = inUnits(panel, where);
    ImGui::SetNextWindowPos(rect.min);
    ImGui::SetNextWindowSize(rect.size);
    if (ImGui::Begin(name, nullptr, kDocked))
        contents();
    ImGui::End();
}

void sections(const PanelContext& panel) {
    panelHeader(panel);
    ImGui::BeginChild("sections", {0.0f, 0.0f}, false, ImGuiWindowFlags_NavFlattened);
    panelFilter(panel);
    panelLights(panel);
    panelTime(panel);
    panelView(panel);
    panelParameters(panel);
    panelCamera(panel);
    panelFiles(panel);
    ImGui::EndChild();
}

// Passes above, the inspector below; each has all if it is alone.
void sideSections(const PanelContext& panel) {
    const bool both = panel.state.showPasses && panel.state.showInspector;
    const float half = both ? 0.5f * ImGui::GetContentRegionAvail().y : 0.0f;
    if (panel.state.showPasses) {
        ImGui::BeginChild("passes", {0.0f, half}, false, ImGuiWindowFlags_NavFlattened);
        sidePasses(panel);
        ImGui::EndChild();
    }
    if (panel.state.showInspector) {
        ImGui::BeginChild("inspector", {0.0f, 0.0f}, false, ImGuiWindowFlags_NavFlattened);
        sideInspector(panel);
        ImGui::EndChild();
    }
}

} // namespace

Ui::Ui(GLFWwindow* window, float contentScale) : context_(ImGui::CreateContext()) {
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr; // leaves no files behind
    io.LogFilename = nullptr;
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    ImGui_ImplOpenGL3_Init("#version 450 core");
    loadFontsFor(contentScale);
}

Ui::~Ui() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext(context_);
}

void Ui::loadFontsFor(float contentScale) {
    if (contentScale == contentScale_)
        return;
    contentScale_ = contentScale;
    ImGui::GetIO().Fonts->Clear();
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    fonts_ = loadFonts(contentScale);
    ImGui_ImplOpenGL3_CreateFontsTexture();
}

LayoutWishes Ui::wishes(const ViewState& state) const {
    const auto pixels = [&](bool shown, float units) {
        return shown ? int(std::round(units * contentScale_)) : 0;
    };
    return {.panel = pixels(state.preferences.showPanel, kPanelWidth),
            .side = pixels(state.showInspector || state.showPasses, kSideWidth),
            .curves = pixels(state.showCurves, kCurvesHeight),
            .strip = pixels(state.showStrip, kStripHeight)};
}

bool Ui::wantsMouse() const {
    return ImGui::GetIO().WantCaptureMouse;
}

bool Ui::coversPictures(const ViewState& state) const {
    const bool mayCover = state.tourStop || state.showPresets || state.showHelp ||
                          ImGui::IsAnyItemActive() ||
                          ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
    return mayCover && wantsMouse();
}

bool Ui::wantsKeyboard() const {
    return ImGui::GetIO().WantTextInput;
}

// In the panel arrows move, Space and Enter press.
void Ui::followKeyboard(const ViewState& state) {
    if (state.keyboardInPanel == keyboardInPanel_)
        return;
    keyboardInPanel_ = state.keyboardInPanel;
    ImGuiIO& io = ImGui::GetIO();
    if (keyboardInPanel_) {
        io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
        ImGui::SetWindowFocus("panel");
    } else {
        io.ConfigFlags &= ~ImGuiConfigFlags_NavEnableKeyboard;
        ImGui::SetWindowFocus(nullptr);
    }
}

void Ui::draw(Workbench& workbench, const UiFrame& frame) {
    const float uiScale = workbench.state.preferences.uiScale;
    loadFontsFor(uiScale > 0.0f ? uiScale : frame.contentScale);
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    // Some systems count the window in units of several pixels.
    // Window and framebuffer are asked for one after the other: in the middle of a resize their
    // ratio may be anything. No screen has more than four pixels a unit.
    const float pixelsPerUnit = std::clamp(ImGui::GetIO().DisplayFramebufferScale.x, 1.0f, 4.0f);
    ImGui::GetIO().FontGlobalScale = 1.0f / pixelsPerUnit;
    applyTheme(contentScale_ / pixelsPerUnit);
    ImGui::NewFrame();
    ImGui::PushFont(fonts_.text);

    const PanelContext panel{workbench, workbench.state, frame, fonts_, 1.0f / pixelsPerUnit};
    followKeyboard(workbench.state);
    docked(panel, "panel", frame.layout.panel, [&] { sections(panel); });
    docked(panel, "side", frame.layout.side, [&] { sideSections(panel); });
    docked(panel, "curves", frame.layout.curves, [&] { dockCurves(panel); });
    docked(panel, "strip", frame.layout.strip, [&] { dockStrip(panel); });
    overlayPanes(panel);
    overlayProbes(panel);
    overlayLegend(panel);
    overlayStatus(panel);
    overlayOracle(panel);
    overlayNotice(panel);
    if (panel.state.tourStop)
        overlayTour(panel);
    if (panel.state.showPresets)
        overlayPresets(panel);
    if (panel.state.showHelp)
        overlayHelp(panel);

    ImGui::PopFont();
    ImGui::Render();
    const ClipControl standard;
    glUseProgram(0); // the back end restores what it finds, which a reload may have deleted
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

} // namespace afterglow
