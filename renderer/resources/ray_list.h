// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/buffer.h"
#include "shared/ray_list.h"

#include <glm/glm.hpp>

namespace afterglow {

/// Rays that are to be traced: shared/ray_list.h.
struct RayList {
    RayList() = default;
    /// Room for a ray of each pixel.
    explicit RayList(glm::ivec2 size);

    std::size_t bytes() const { return rays.bytes() + counts.bytes(); }

    TexelBuffer rays;   ///< kTexelsPerRay texels a place
    TexelBuffer counts; ///< R32UI: of each segment
};

/// The number of segments along each axis of a picture: ceil(size / kSegmentSize).
glm::ivec2 segmentsOf(glm::ivec2 size);

/// The size of a dispatch over the list of a picture: one invocation a place.
glm::ivec2 invocationsOf(glm::ivec2 size);

} // namespace afterglow
