// SPDX-License-Identifier: MIT
#pragma once

#include "app/workbench/keymap.h"

#include <array>
#include <span>
#include <string>

#include <glm/glm.hpp>

namespace afterglow {

struct ViewState;

/// The actions that let something happen in the scene: what repeats is one of them.
inline constexpr std::array kSceneActions{
    Action::ToggleLight,      ///< on or off
    Action::DimLight,         ///< to half its power and back
    Action::ColorLight,       ///< to another color of equal luminance and back
    Action::ToggleAnimation,  ///< starts or stops what moves in the scene
    Action::CutCamera,        ///< to the next camera or bookmark
    Action::ToggleCameraPath, ///< starts or stops the camera's way
};
bool isLightAction(Action action); ///< of one light: Command::index is its slot

/// Returns what the action will do: "toggle key", "camera cut".
std::string nameOf(const Command& event, std::span<const std::string> lightNames);

/// Performs the action, and keeps it as the one that repeats. Does nothing without such a light.
void letHappen(ViewState& state, const Command& event);

/// Returns the tint that turns light of this color (linear rgb) to another hue and leaves its
/// luminance as it is: what a gradient of luminance cannot see. White becomes blue; the key light
/// of the Cornell box does what it does in the experiment light-color. Light of one primary keeps
/// its hue.
glm::vec3 equalLuminanceTint(glm::vec3 color);

} // namespace afterglow
