#pragma once

#include "renderer/pipeline/light_state.h"
#include "renderer/scene/camera.h"

#include <cstdint>
#include <string>
#include <vector>

namespace afterglow {

/// What one frame is given from outside, and what is to be said about it. Filters and their
/// settings are not part of it.
struct FrameMoment {
    double seconds = 0.0; ///< scene time
    Camera camera{};
    std::vector<LightState> lights{}; ///< by slot; missing ones are as the scene has them
    std::vector<std::string> marks{}; ///< what happens in it: "key off"
    bool step = false;                ///< light alone has changed: there is a response to measure

    bool operator==(const FrameMoment&) const = default;
};

/// Frames one after the other, as they were given or are to be.
struct Take {
    std::string name{};
    std::uint32_t firstFrame = 0; ///< the number of the first frame: its noise follows from it
    std::vector<FrameMoment> frames{};

    bool operator==(const Take&) const = default;
};

} // namespace afterglow
