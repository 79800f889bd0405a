#include "app/ui/ui.h"

#include "app/ui/panels.h"
#include "app/window/window.h"

#include <algorithm>
#include <cmath>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

namespace afterglow {
namespace {

constexpr float kPanelWidth = 372.0f; // units of the design

// Dear ImGui expects the clip space that OpenGL has from the start.
class ClipControl {
public:
    ClipControl() { glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE); }
    ~ClipControl() { glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE); }
    ClipControl(const ClipControl&) = delete;
    ClipControl& operator=(const ClipControl&) = delete;
};

void sidePanel(const PanelContext& panel) {
    const Rect& where = panel.frame.layout.panel;
    if (where.empty())
        return;
    ImGui::SetNextWindowPos({float(where.min.x) * panel.scale, float(where.min.y) * panel.scale});
    ImGui::SetNextWindowSize(
        {float(where.size.x) * panel.scale, float(where.size.y) * panel.scale});
    ImGui::Begin("panel", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus);
    panelHeader(panel);
    ImGui::BeginChild("sections", {0.0f, 0.0f}, false, ImGuiWindowFlags_None);
    panelFilter(panel);
    panelLights(panel);
    panelView(panel);
    panelTimings(panel);
    panelMotion(panel);
    panelParameters(panel);
    ImGui::EndChild();
    ImGui::End();
}

} // namespace

Ui::Ui(Window& window) : window_(window), context_(ImGui::CreateContext()) {
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr; // leaves no files behind
    io.LogFilename = nullptr;
    ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
    ImGui_ImplOpenGL3_Init("#version 450 core");
    loadFontsFor(window.contentScale());
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

int Ui::panelWidth() const {
    return int(std::round(kPanelWidth * contentScale_));
}

bool Ui::wantsMouse() const {
    return ImGui::GetIO().WantCaptureMouse;
}

bool Ui::wantsKeyboard() const {
    return ImGui::GetIO().WantTextInput;
}

void Ui::draw(ViewState& state, const UiFrame& frame) {
    loadFontsFor(window_.contentScale());
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    // Some systems count the window in units of several pixels.
    // Window and framebuffer are asked for one after the other: in the middle of a resize their ratio
    // may be anything. No screen has more than four pixels a unit.
    const float pixelsPerUnit = std::clamp(ImGui::GetIO().DisplayFramebufferScale.x, 1.0f, 4.0f);
    ImGui::GetIO().FontGlobalScale = 1.0f / pixelsPerUnit;
    applyTheme(contentScale_ / pixelsPerUnit);
    ImGui::NewFrame();
    ImGui::PushFont(fonts_.text);

    const PanelContext panel{state, frame, fonts_, 1.0f / pixelsPerUnit};
    sidePanel(panel);
    overlayLegend(panel);
    overlayStatus(panel);
    overlayNotice(panel);
    if (state.showHelp)
        overlayHelp(panel);

    ImGui::PopFont();
    ImGui::Render();
    const ClipControl standard;
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

} // namespace afterglow
