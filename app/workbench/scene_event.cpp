// SPDX-License-Identifier: MIT
#include "app/workbench/scene_event.h"

#include "app/workbench/view_state.h"
#include "renderer/image/color.h"

namespace afterglow {
namespace {

constexpr float kDimmed = 0.5f;
constexpr glm::vec3 kBlue{0.25f, 1.21157f, 2.6f}; // the tint of the experiment light-color

/// Returns the change of a light that an event causes from its present state.
LightEvent lightEvent(const ViewState& state, const SceneEvent& what) {
    constexpr glm::vec3 kWhite{1.0f};
    const LightState& light = state.lights[what.slot];
    LightEvent event{.light = state.lightNames[what.slot]};
    if (what.kind == EventKind::Toggle)
        event.on = !light.on;
    else if (what.kind == EventKind::Dim)
        event.power = light.power == kDimmed ? 1.0f : kDimmed;
    else
        event.tint =
            light.tint == kWhite ? equalLuminanceTint(state.lightColors[what.slot]) : kWhite;
    return event;
}

} // namespace

bool concernsLight(EventKind kind) {
    return kind <= EventKind::Recolor;
}

std::string nameOf(const SceneEvent& event, std::span<const std::string> lightNames) {
    constexpr const char* kNames[] = {
        "toggle ", "dim ", "recolor ", "start or stop what moves", "camera cut", "camera path"};
    const std::string name = kNames[std::size_t(event.kind)];
    if (!concernsLight(event.kind))
        return name;
    return name + (event.slot < lightNames.size() ? lightNames[event.slot] : "no light");
}

void letHappen(ViewState& state, const SceneEvent& event) {
    if (concernsLight(event.kind)) {
        if (event.slot >= state.lights.size())
            return;
        LightState& light = state.lights[event.slot];
        light = withEvent(light, lightEvent(state, event));
    } else if (event.kind == EventKind::Animation) {
        toggleAnimation(state);
        state.marks.push_back(state.time.animate ? "movement starts" : "movement stops");
    } else if (event.kind == EventKind::CameraCut) {
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
