// SPDX-License-Identifier: MIT
#pragma once

#include "app/ui/ui.h"
#include "app/window/presenter.h"
#include "app/window/view.h"
#include "app/window/window.h"
#include "app/workbench/pointer.h"
#include "app/workbench/workbench.h"

#include <chrono>

namespace afterglow {

/// The frame loop: hands on, to the workbench, the window and the interface, what each has for the
/// others.
class Viewer {
public:
    Viewer(const ViewOptions& options, Scene scene, ViewState state);

    void run(); ///< until the window is closed
    const Preferences& preferences() const { return workbench_.state.preferences; }

private:
    using Clock = std::chrono::steady_clock;

    void takeInput(const WindowInput& input, double seconds);
    void takeStrokes(const WindowInput& input);
    void flyCamera(const WindowInput& input, double seconds);
    void pointAt(const WindowInput& input);
    void serveRequests();
    void drawWindow(glm::ivec2 framebuffer, const Layout& layout);
    void updateTitle();
    void rememberWindow();
    bool isLastFrame() const;
    void measureUiCost();

    const ViewOptions& options_;
    Window window_;
    GlInfo gl_;
    ShaderLibrary shaders_;
    Workbench workbench_;
    Presenter presenter_;
    Ui ui_;
    Pointer pointer_;

    std::vector<PanePlace> places_; ///< of the last round
    bool looking_ = false;
    bool vsync_ = true;
    std::string title_;
    Clock::time_point titled_{};
    int rendered_ = 0; ///< frames
};

} // namespace afterglow
