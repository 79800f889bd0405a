// SPDX-License-Identifier: MIT
#include "app/workbench/scene_event.h"

#include "app/workbench/view_state.h"
#include "renderer/image/color.h"

namespace afterglow {
namespace {

constexpr float kDimmed = 0.5f;
constexpr glm::vec3 kBlue{0.25f, 1.21157f, 2.6f}; // the tint of the experiment light-color

/// Returns the event that a light's action causes from the light's present state.
LightEvent lightEvent(const ViewState& state, Action action, std::size_t slot) {
    constexpr glm::vec3 kWhite{1.0f};
    const LightState& light = state.lights[slot];
    LightEvent event{.light = state.lightNames[slot]};
    if (action == Action::ToggleLight)
        event.on = !light.on;
    else if (action == Action::DimLight)
        event.power = light.power == kDimmed ? 1.0f : kDimmed;
    else
        event.tint = light.tint == kWhite ? equalLuminanceTint(state.lightColors[slot]) : kWhite;
    return event;
}

} // namespace

bool isLightAction(Action action) {
    return action == Action::ToggleLight || action == Action::DimLight ||
           action == Action::ColorLight;
}

std::string nameOf(const Command& event, std::span<const std::string> lightNames) {
    const auto slot = std::size_t(event.index);
    const std::string light = slot < lightNames.size() ? lightNames[slot] : "no light";
    switch (event.action) {
    case Action::ToggleLight: return "toggle " + light;
    case Action::DimLight: return "dim " + light;
    case Action::ColorLight: return "recolor " + light;
    case Action::ToggleAnimation: return "start or stop what moves";
    case Action::CutCamera: return "camera cut";
    case Action::ToggleCameraPath: return "camera path";
    default: return {};
    }
}

void letHappen(ViewState& state, const Command& event) {
    if (isLightAction(event.action)) {
        const auto slot = std::size_t(event.index);
        if (slot >= state.lights.size())
            return;
        state.lights[slot] = withEvent(state.lights[slot], lightEvent(state, event.action, slot));
    } else if (event.action == Action::ToggleAnimation) {
        toggleAnimation(state);
        state.marks.push_back(state.time.animate ? "movement starts" : "movement stops");
    } else if (event.action == Action::CutCamera) {
        cutCamera(state);
    } else {
        state.onPath = !state.onPath;
        if (state.onPath)
            state.pathSeconds = 0.0;
        state.marks.push_back(state.onPath ? "camera starts" : "camera stops");
    }
    state.repeated = event;
}

glm::vec3 equalLuminanceTint(glm::vec3 color) {
    const float before = luminance(color), after = luminance(color * kBlue);
    return after > 0.0f ? kBlue * (before / after) : kBlue;
}

} // namespace afterglow
