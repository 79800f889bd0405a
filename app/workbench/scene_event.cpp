#include "app/workbench/scene_event.h"

#include "app/workbench/view_state.h"
#include "renderer/image/color.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace afterglow {
namespace {

constexpr float kDimmed = 0.5f;
constexpr glm::vec3 kBlue{0.25f, 1.21157f, 2.6f}; // the tint of the experiment light-color

// Uniform Catmull-Rom: through b and c, with a before and d after.
glm::vec3 between(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, float t) {
    return 0.5f * ((2.0f * b) + (c - a) * t + (2.0f * a - 5.0f * b + 4.0f * c - d) * t * t +
                   (3.0f * b - a - 3.0f * c + d) * t * t * t);
}

} // namespace

bool isLightEvent(SceneEvent::Kind kind) {
    return kind == SceneEvent::Kind::ToggleLight || kind == SceneEvent::Kind::DimLight ||
           kind == SceneEvent::Kind::ColorLight;
}

std::string nameOf(const SceneEvent& event, std::span<const std::string> lightNames) {
    const std::string light =
        event.light < lightNames.size() ? lightNames[event.light] : "no light";
    switch (event.kind) {
    case SceneEvent::Kind::ToggleLight: return "toggle " + light;
    case SceneEvent::Kind::DimLight: return "dim " + light;
    case SceneEvent::Kind::ColorLight: return "recolor " + light;
    case SceneEvent::Kind::Animation: return "start or stop what moves";
    case SceneEvent::Kind::CameraCut: return "camera cut";
    case SceneEvent::Kind::CameraPath: return "camera path";
    }
    return {};
}

void cause(ViewState& state, const SceneEvent& event) {
    if (isLightEvent(event.kind) && event.light >= state.lights.size())
        return;
    state.repeated = event;
    LightState* const light = isLightEvent(event.kind) ? &state.lights[event.light] : nullptr;
    switch (event.kind) {
    case SceneEvent::Kind::ToggleLight: light->on = !light->on; return;
    case SceneEvent::Kind::DimLight:
        light->power = light->power == kDimmed ? 1.0f : kDimmed;
        return;
    case SceneEvent::Kind::ColorLight:
        light->tint = light->tint == glm::vec3(1.0f)
                          ? equalLuminanceTint(state.lightColors[event.light])
                          : glm::vec3(1.0f);
        return;
    case SceneEvent::Kind::Animation:
        toggleAnimation(state);
        state.marks.push_back(state.time.animate ? "movement starts" : "movement stops");
        return;
    case SceneEvent::Kind::CameraCut: return cutCamera(state);
    case SceneEvent::Kind::CameraPath:
        state.onPath = !state.onPath;
        if (state.onPath)
            state.pathSeconds = 0.0;
        state.marks.push_back(state.onPath ? "camera starts" : "camera stops");
        return;
    }
}

glm::vec3 equalLuminanceTint(glm::vec3 color) {
    const float before = luminance(color), after = luminance(color * kBlue);
    return after > 0.0f ? kBlue * (before / after) : kBlue;
}

std::vector<std::string> describeChange(std::span<const std::string> names,
                                        std::span<const LightState> before,
                                        std::span<const LightState> after) {
    std::vector<std::string> changes;
    for (std::size_t i = 0; i < std::min({names.size(), before.size(), after.size()}); ++i) {
        if (before[i] == after[i])
            continue;
        std::string text = names[i];
        if (before[i].on != after[i].on)
            text += after[i].on ? " on" : " off";
        if (before[i].power != after[i].power) {
            char power[32];
            std::snprintf(power, sizeof power, " to %.4g %%", double(after[i].power) * 100.0);
            text += power;
        }
        if (before[i].tint != after[i].tint)
            text += after[i].tint == glm::vec3(1.0f) ? " untinted" : " tinted";
        changes.push_back(std::move(text));
    }
    return changes;
}

Camera onPath(std::span<const Camera> keys, double seconds) {
    const double place = seconds / kSecondsPerKey;
    const auto leg = std::int64_t(std::floor(place));
    const float t = float(place - double(leg));
    const auto n = std::int64_t(keys.size());
    const auto key = [&](std::int64_t i) -> const Camera& {
        return keys[std::size_t((((leg + i) % n) + n) % n)];
    };
    Camera camera = key(0);
    camera.position =
        between(key(-1).position, key(0).position, key(1).position, key(2).position, t);
    const float eased = t * t * (3.0f - 2.0f * t); // it turns slowly where it changes its mind
    camera.orientation = glm::normalize(glm::slerp(key(0).orientation, key(1).orientation, eased));
    camera.lens.verticalFov = glm::mix(key(0).lens.verticalFov, key(1).lens.verticalFov, eased);
    return camera;
}

std::vector<Camera> swayAround(const Camera& home, float distance) {
    const glm::vec3 target = home.position + distance * home.forward();
    const glm::vec3 right = home.orientation * glm::vec3(1.0f, 0.0f, 0.0f);
    const glm::vec3 up{0.0f, 1.0f, 0.0f};
    std::vector<Camera> keys;
    for (const glm::vec2 place :
         {glm::vec2(0.0f, 0.0f), {0.22f, 0.03f}, {0.0f, 0.06f}, {-0.22f, 0.03f}}) {
        const glm::vec3 eye = home.position + distance * (place.x * right + place.y * up);
        keys.push_back(lookAt(eye, target, home.lens));
    }
    keys.front() = home;
    return keys;
}

} // namespace afterglow
