// SPDX-License-Identifier: MIT
#include "app/scenario/scene_frame.h"

#include "renderer/pipeline/renderer.h"

#include <algorithm>

namespace afterglow {

FrameInput SceneFrame::input(std::uint32_t seed) const {
    return {.camera = camera, .seconds = seconds, .frame = frame, .seed = seed, .lights = lights};
}

LightState lightIn(std::span<const LightState> lights, std::size_t slot) {
    return slot < lights.size() ? lights[slot] : LightState{};
}

SceneChange changeBetween(const Scene& scene, const FrameInput& before, const FrameInput& after) {
    SceneChange change{.camera = before.camera != after.camera};
    for (std::size_t slot = 0; slot < scene.lights.size(); ++slot)
        if (lightIn(before.lights, slot).scale() != lightIn(after.lights, slot).scale())
            change.lights = true;
    if (before.seconds == after.seconds || scene.tracks.empty())
        return change;
    const Pose then = poseAt(scene, before.seconds), now = poseAt(scene, after.seconds);
    change.world = std::ranges::any_of(scene.instances, [&](const Instance& instance) {
        return then.worldFromNode[instance.node] != now.worldFromNode[instance.node];
    });
    return change;
}

} // namespace afterglow
