// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "shared/bindings.h"
#include "shared/denoise_params.h"
#include "tests/reference/edge_stops.h"

namespace afterglow::reference {

/// The value a share `q` of the way through the sorted values, of which there is at least one.
inline double percentile(const std::vector<double>& sorted, double q) {
    const double place = q * double(sorted.size() - 1);
    const auto below = std::size_t(place);
    if (below + 1 == sorted.size())
        return sorted.back();
    return sorted[below] + (place - double(below)) * (sorted[below + 1] - sorted[below]);
}

/// Low and high percentile of the raw luminance of each tile, widened to hold its mean, and its
/// foreground pixels.
inline Image<glm::dvec4> luminanceRange(const Image<glm::vec4>& raw, const Image<glm::vec4>& guides,
                                        const gpu::PercentileParams& params) {
    const int edge = int(gpu::kTileSize);
    Image<glm::dvec4> result((raw.size() + edge - 1) / edge);
    for (int ty = 0; ty < result.size().y; ++ty)
        for (int tx = 0; tx < result.size().x; ++tx) {
            std::vector<double> values;
            for (int y = edge * ty; y < std::min(edge * (ty + 1), raw.size().y); ++y)
                for (int x = edge * tx; x < std::min(edge * (tx + 1), raw.size().x); ++x)
                    if (!isBackground(guides({x, y})))
                        values.push_back(raw({x, y}).a);
            if (values.empty())
                continue;
            std::sort(values.begin(), values.end());
            double mean = 0.0;
            for (const double value : values)
                mean += value / double(values.size());
            result({tx, ty}) = {std::min(mean, percentile(values, params.lowPercentile)),
                                std::max(mean, percentile(values, params.highPercentile)),
                                double(values.size()), 0.0};
        }
    return result;
}

} // namespace afterglow::reference
