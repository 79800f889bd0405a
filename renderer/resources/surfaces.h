// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/texture.h"

#include <vector>

namespace afterglow {

/// The G-buffer of a picture, or of gradient samples beside one: one surface a texel. Contents are
/// specified in docs/pipeline.md.
struct Surfaces {
    Surfaces() = default;
    /// Makes all images zero: background. `prefix` begins the label of each image.
    explicit Surfaces(glm::ivec2 size, std::string_view prefix = {});

    glm::ivec2 size() const { return visibility.size(); }
    bool empty() const { return size().x == 0; }
    std::vector<const GpuTexture*> all() const;

    GpuTexture visibility; ///< what the others are made from
    GpuTexture surface, guides, slope, motion, albedo, emission;
};

} // namespace afterglow
