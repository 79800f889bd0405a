// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/pipeline/light_state.h"
#include "renderer/scene/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace afterglow {

struct FrameInput;

/// One frame of a scene: number, time, camera, lights and marks. Filters and settings are not part
/// of it.
struct SceneFrame {
    std::uint32_t frame = 0; ///< its number: its noise follows from it
    double seconds = 0.0;    ///< scene time
    Camera camera{};
    std::vector<LightState> lights{}; ///< by slot; missing ones are as the scene has them
    std::vector<std::string> marks{}; ///< the events in it: "key off"
    bool step = false;                ///< light alone has changed: there is a response to measure

    /// Returns what the renderer takes. Its lights are these, which must outlive it.
    FrameInput input(std::uint32_t seed) const;

    bool operator==(const SceneFrame&) const = default;
};

/// A recorded sequence of frames. Their numbers rise by one.
struct Take {
    std::string name{};
    std::vector<SceneFrame> frames{};

    bool operator==(const Take&) const = default;
};

/// Returns the state of a light in a list that may miss it: it is as the scene has it.
LightState lightIn(std::span<const LightState> lights, std::size_t slot);

/// The differences between two frames of a scene.
struct SceneChange {
    bool lights = false; ///< a light shines differently
    bool world = false;  ///< an instance is in another place: what is lit, or casts a shadow
    bool camera = false;

    /// Returns whether surfaces may reflect other light.
    bool relights() const { return lights || world; }
    /// Returns whether light alone has changed: there is a step response.
    bool isStep() const { return lights && !world && !camera; }
    bool any() const { return lights || world || camera; }
};
SceneChange changeBetween(const Scene& scene, const FrameInput& before, const FrameInput& after);

} // namespace afterglow
