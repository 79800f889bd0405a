// SPDX-License-Identifier: MIT
#pragma once

#include "shared/denoise_params.h"
#include "tests/reference/edge_stops.h"

namespace afterglow::reference {

struct VarianceInputs {
    const Image<glm::vec4>& accumulated;
    const Image<glm::vec4>& moments;
    const Image<glm::vec4>& guides;
    const Image<glm::vec2>& slope;
};

/// Both moments at p averaged over 7x7 pixels of the same surface.
inline glm::dvec2 spatialMoments(const VarianceInputs& in, const gpu::VarianceParams& params,
                                 glm::ivec2 p) {
    glm::dvec2 sum(0.0);
    double total = 0.0;
    for (int y = -3; y <= 3; ++y)
        for (int x = -3; x <= 3; ++x) {
            const glm::ivec2 q = p + glm::ivec2(x, y);
            if (!in.guides.contains(q) || isBackground(in.guides(q)))
                continue;
            const double w =
                depthWeight(in.guides(p), in.guides(q), in.slope(p), p - q, params.sigmaDepth) *
                normalWeight(in.guides(p), in.guides(q), params.sigmaNormal);
            sum += w * glm::dvec2(in.moments(q));
            total += w;
        }
    return sum / total;
}

/// The accumulated signal and the variance of its luminance. Schied et al. 2017, section 4.2; with
/// an exponent, that of a mean over the history.
inline Image<glm::dvec4> variance(const VarianceInputs& in, const gpu::VarianceParams& params) {
    Image<glm::dvec4> result(in.guides.size());
    for (int py = 0; py < in.guides.size().y; ++py)
        for (int px = 0; px < in.guides.size().x; ++px) {
            const glm::ivec2 p{px, py};
            if (isBackground(in.guides(p)))
                continue;
            const double history = in.moments(p).z;
            const double wanted = params.minHistory;
            const bool isLong = history >= wanted;
            const glm::dvec2 mu =
                isLong ? glm::dvec2(in.moments(p)) : spatialMoments(in, params, p);
            const double n = std::max(history, 1.0);
            const double exponent = params.varianceExponent;
            double factor =
                std::pow(n, -exponent) * (1.0 + double(params.shortHistoryBoost) / (n * n));
            if (!isLong && exponent == 0.0)
                factor *= wanted / n;
            result(p) = glm::dvec4(glm::dvec3(in.accumulated(p)),
                                   factor * std::max(0.0, mu.y - mu.x * mu.x));
        }
    return result;
}

} // namespace afterglow::reference
