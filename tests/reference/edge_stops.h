// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "renderer/image/image.h"
#include "renderer/passes/frame_context.h"

// The weights that keep a filter from crossing edges. Schied et al. 2017, section 4.4, equations 3
// to 5, with the scale-free depth term of docs/pipeline.md.
//
// Everything in this folder is written from the papers and docs/pipeline.md, in double precision
// and with no thought for speed; nothing here may be taken from the shaders.

namespace afterglow::reference {

/// A pixel of the guides image: unit normal, depth in meters (0: background).
inline bool isBackground(const glm::vec4& guide) {
    return guide.w == 0.0f;
}

/// Equation 3. `offset` is p - q in pixels; `slope` is that of p, meters per pixel.
inline double depthWeight(const glm::vec4& p, const glm::vec4& q, glm::dvec2 slope,
                          glm::dvec2 offset, double sigma) {
    const double predicted = std::abs(glm::dot(slope, offset));
    const double reach = sigma * predicted + 1e-3 * double(p.w);
    return std::exp(-std::abs(double(p.w) - double(q.w)) / reach);
}

/// Equation 4.
inline double normalWeight(const glm::vec4& p, const glm::vec4& q, double sigma) {
    const double cosine = glm::dot(glm::dvec3(p), glm::dvec3(q));
    return cosine > 0.0 ? std::pow(cosine, sigma) : 0.0;
}

/// Equation 5. `variance` is that of the luminance around p, already blurred.
inline double luminanceWeight(double p, double q, double variance, double sigma) {
    const double deviation = std::sqrt(std::max(0.0, variance));
    return std::exp(-std::abs(p - q) / (sigma * deviation + 1e-6));
}

/// Alpha channel under the 3x3 binomial kernel, coordinates clamped to the image.
inline double blurredAlpha(const Image<glm::vec4>& image, glm::ivec2 p) {
    double sum = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const glm::ivec2 q = glm::clamp(p + glm::ivec2(x, y), glm::ivec2(0), image.size() - 1);
            const double weight = (x == 0 ? 2.0 : 1.0) * (y == 0 ? 2.0 : 1.0) / 16.0;
            sum += weight * double(image(q).a);
        }
    return sum;
}

/// Taps on each side of the center.
inline int radius(Kernel kernel) {
    return kernel == Kernel::B3Spline5x5 ? 2 : 1;
}

/// The share of the tap at `k`, each coordinate in [-radius, radius].
inline double share(Kernel kernel, glm::ivec2 k) {
    if (kernel == Kernel::Box3x3)
        return 1.0 / 9.0;
    constexpr double spline[] = {3.0 / 8.0, 1.0 / 4.0, 1.0 / 16.0};
    return spline[std::abs(k.x)] * spline[std::abs(k.y)];
}

} // namespace afterglow::reference
