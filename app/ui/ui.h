#pragma once

#include "app/ui/theme.h"
#include "app/workbench/pass_timings.h"
#include "app/workbench/view_state.h"
#include "renderer/gl/context.h"
#include "renderer/pipeline/renderer.h"

#include <span>
#include <string>

struct ImGuiContext;

namespace afterglow {

class Window;

/// What the interface shows and cannot change.
struct UiFrame {
    const Scene& scene;
    const SceneStats& sceneStats;
    const GlInfo& gl;
    const PassTimings& timings;
    Layout layout;           ///< framebuffer pixels
    glm::ivec2 imageSize{0}; ///< as rendered
    FrameStats stats;        ///< of a recent frame
    double raysPerSecond = 0.0;
    std::size_t imageBytes = 0;                ///< of all images on the device
    std::span<const std::string> shaderErrors; ///< from the last attempt to reload shaders
};

/// Panels and overlays by Dear ImGui. They hold no state that matters: everything is in ViewState.
class Ui {
public:
    explicit Ui(Window& window);
    ~Ui();
    Ui(const Ui&) = delete;
    Ui& operator=(const Ui&) = delete;

    int panelWidth() const; ///< framebuffer pixels

    /// Draws over what is in the back buffer, and changes the state as widgets are used.
    void draw(ViewState& state, const UiFrame& frame);

    bool wantsMouse() const;    ///< it is over a panel, or a widget holds it
    bool wantsKeyboard() const; ///< somebody types

private:
    void loadFontsFor(float contentScale);

    Window& window_;
    ImGuiContext* context_;
    Fonts fonts_;
    float contentScale_ = 0.0f; ///< that the fonts are made for
};

} // namespace afterglow
