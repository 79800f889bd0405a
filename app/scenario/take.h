// SPDX-License-Identifier: MIT
#pragma once

#include "app/scenario/scene_frame.h"

#include <string>
#include <vector>

namespace afterglow {

/// A recorded sequence of frames. Their numbers rise by one.
struct Take {
    std::string name{};
    std::vector<SceneFrame> frames{};

    bool operator==(const Take&) const = default;
};

} // namespace afterglow
