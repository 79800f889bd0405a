#pragma once

#include "app/scenario/scene_frame.h"

#include <cstdint>
#include <string>
#include <vector>

namespace afterglow {

/// Frames one after the other, as they were given or are to be.
struct Take {
    std::string name{};
    std::uint32_t firstFrame = 0; ///< the number of the first frame: its noise follows from it
    std::vector<SceneFrame> frames{};

    bool operator==(const Take&) const = default;
};

} // namespace afterglow
