// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

#include "renderer/image/image.h"

// The automatic exposure in double precision: docs/pipeline.md, "Automatic exposure".

namespace afterglow::reference {

struct Exposure {
    double stops = 0.0, mean = 0.0, pixels = 0.0;
};

/// `previous`: the stops of the frame before; null: none.
inline Exposure exposure(const Image<glm::vec4>& composed, const Image<glm::vec4>& guides,
                         const double* previous, double frames, double limit) {
    Exposure out;
    for (std::size_t i = 0; i < composed.pixels().size(); ++i) {
        if (guides.pixels()[i].w == 0.0f)
            continue;
        const glm::dvec3 c(composed.pixels()[i]);
        const double l = 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
        out.mean += std::log2(std::max(l, 1.0 / 1024.0));
        out.pixels += 1.0;
    }
    out.stops = previous ? *previous : 0.0;
    if (out.pixels == 0.0)
        return out;
    out.mean /= out.pixels;
    const double target = std::clamp(std::log2(0.18) - out.mean, -limit, limit);
    out.stops = previous ? target + (*previous - target) * std::exp(-1.0 / frames) : target;
    return out;
}

} // namespace afterglow::reference
