// SPDX-License-Identifier: MIT
#pragma once

#include "app/ui/theme.h"
#include "app/workbench/layout.h"
#include "app/workbench/pointer.h"
#include "app/workbench/tour.h"
#include "app/workbench/workbench.h"

#include <span>

struct GLFWwindow;
struct ImGuiContext;

namespace afterglow {

/// What the interface is drawn around.
struct UiFrame {
    Layout layout;                     ///< framebuffer pixels
    std::span<const PanePlace> places; ///< where the panes' pictures are
    const Pointer& pointer;
    float contentScale; ///< of the monitor: 2 where letters need twice the pixels
};

/// Panels and overlays by Dear ImGui. They hold no state that matters: everything is in the
/// workbench's ViewState.
class Ui {
public:
    Ui(GLFWwindow* window, float contentScale);
    ~Ui();
    Ui(const Ui&) = delete;
    Ui& operator=(const Ui&) = delete;

    /// The room that what is open wants, in framebuffer pixels.
    LayoutWishes wishes(const ViewState& state) const;

    /// Draws over what is in the back buffer, and changes the state as widgets are used.
    void draw(Workbench& workbench, const UiFrame& frame);

    bool wantsMouse() const; ///< it is over a panel, or a widget holds it
    /// Something lies over the pictures and has the mouse, or a widget holds it. Where the mouse is
    /// over a panel beside them this does not tell: it may have moved on since the last frame.
    bool coversPictures(const ViewState& state) const;
    bool wantsKeyboard() const; ///< somebody types

private:
    void loadFontsFor(float contentScale);
    void followKeyboard(const ViewState& state);

    ImGuiContext* context_;
    Fonts fonts_;
    float contentScale_ = 0.0f;    ///< that the fonts are made for
    bool keyboardInPanel_ = false; ///< as the state had it in the last frame
};

} // namespace afterglow
