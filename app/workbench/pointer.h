// SPDX-License-Identifier: MIT
#pragma once

#include "app/workbench/view_state.h"

#include <optional>
#include <span>

namespace afterglow {

/// What the left button of the mouse does on the pictures: it drags the divider of a wipe, chooses
/// a pane, and sets a probe by a click, which is the box around the pixel, or by dragging a box.
struct Pointer {
    enum class Holds { Nothing, Divider, Probe };
    Holds holds = Holds::Nothing;
    std::size_t pane = 0;   ///< in which a box is dragged
    glm::vec2 start{0.0f};  ///< framebuffer pixels: where the button went down
    glm::ivec2 corner{0};   ///< where it began
    glm::ivec2 opposite{0}; ///< where it is now
    std::size_t probe = 0;  ///< which one it will be
    bool exact = false;     ///< without a drag it will be one pixel
    bool onDivider = false; ///< the mouse holds the divider of a wipe, or is where it would take it
};

/// In framebuffer pixels. `onPicture`: the mouse is not over a panel.
struct PointerInput {
    glm::vec2 position{0.0f};
    bool pressed = false, released = false; ///< the left button, in this round
    bool adds = false;                      ///< Shift: another probe instead of the active one
    bool exact = false;                     ///< Control: a click is one pixel, not a box
    bool onPicture = false;
    float reach = 6.0f; ///< how near to the divider is on it
};

/// One round. Also keeps ViewState::hovered.
void movePointer(Pointer& pointer, ViewState& state, const PointerInput& input,
                 std::span<const PanePlace> places, glm::ivec2 image);

/// The probe that there will be when the button goes up.
std::optional<Probe> draggedProbe(const Pointer& pointer, glm::ivec2 image);

/// The active probe around the pixel under the mouse, if there is one.
void probeAtMouse(ViewState& state, glm::ivec2 image);

} // namespace afterglow
