// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include <glm/glm.hpp>

namespace afterglow {

struct ViewState;

enum class EventKind {
    Toggle,    ///< a light on or off
    Dim,       ///< a light to half its power and back
    Recolor,   ///< a light to another color of equal luminance and back
    Animation, ///< starts or stops what moves in the scene
    CameraCut, ///< to the next camera or bookmark
    CameraPath ///< starts or stops the camera's way
};
inline constexpr std::size_t kEventKinds = 6;
bool concernsLight(EventKind kind);

/// Something that a person lets happen in the scene: what repeats is one of these.
struct SceneEvent {
    EventKind kind = EventKind::Toggle;
    std::size_t slot = 0; ///< of the light that it concerns
    bool operator==(const SceneEvent&) const = default;
};

/// Returns what the event will do: "toggle key", "camera cut".
std::string nameOf(const SceneEvent& event, std::span<const std::string> lightNames);

/// Lets it happen, and keeps it as the one that repeats. Does nothing without such a light.
void letHappen(ViewState& state, const SceneEvent& event);

/// Returns the tint that turns light of this color (linear rgb) to another hue and leaves its
/// luminance as it is: what a gradient of luminance cannot see. White becomes blue; the key light
/// of the Cornell box does what it does in the experiment light-color. Light of one primary keeps
/// its hue.
glm::vec3 equalLuminanceTint(glm::vec3 color);

} // namespace afterglow
