// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/texture.h"
#include "renderer/resources/ray_list.h"

#include <array>

namespace afterglow {

/// The intermediate results of a path's steps. None outlives a frame.
struct PathTargets {
    PathTargets() = default;
    explicit PathTargets(glm::ivec2 size);

    bool empty() const { return weights[0].size().x == 0; }
    std::vector<const GpuTexture*> all() const;
    std::size_t bufferBytes() const { return empty() ? 0 : bounces.bytes() + hits.bytes(); }

    RayList bounces;  ///< the second segments
    TexelBuffer hits; ///< of those: instance, triangle, barycentrics
    // Of two signals the second ones are used too.
    std::array<GpuTexture, 2> weights; ///< RGBA32F: signal a radiance, density in the first
    GpuTexture distances; ///< R32F: to what a specular ray of the pixel hits, meters; 0: none
    std::array<GpuTexture, 2> pending; ///< RGBA32F: signal if the last shadow ray is not blocked
};

} // namespace afterglow
