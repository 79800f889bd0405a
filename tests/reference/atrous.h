// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/image/color.h"
#include "shared/denoise_params.h"
#include "tests/reference/edge_stops.h"

namespace afterglow::reference {

/// The sums of one a-trous iteration over any grid: rgb are averaged by the weights, alpha (a
/// variance) by their squares. `luminanceAt` maps a cell to what equation 5 compares;
/// `pixelsPerCell` is the distance between neighboring cells in pixels.
template <class LuminanceAt>
Image<glm::dvec4> atrousIteration(const Image<glm::vec4>& image, const Image<glm::vec4>& guides,
                                  const Image<glm::vec2>& slope, Kernel kernel,
                                  const gpu::EdgeStopping& params, LuminanceAt luminanceAt,
                                  int pixelsPerCell) {
    Image<glm::dvec4> result(image.size());
    for (int py = 0; py < image.size().y; ++py)
        for (int px = 0; px < image.size().x; ++px) {
            const glm::ivec2 p{px, py};
            if (isBackground(guides(p))) {
                result(p) = glm::dvec4(image(p));
                continue;
            }
            const double variance = blurredAlpha(image, p);
            glm::dvec3 sum(0.0);
            double squares = 0.0, total = 0.0;
            for (int y = -radius(kernel); y <= radius(kernel); ++y)
                for (int x = -radius(kernel); x <= radius(kernel); ++x) {
                    const glm::ivec2 k{x, y};
                    const glm::ivec2 q = p + params.step * k;
                    if (!image.contains(q) || isBackground(guides(q)))
                        continue;
                    const glm::dvec2 offset = double(pixelsPerCell) * glm::dvec2(p - q);
                    const double stops =
                        depthWeight(guides(p), guides(q), slope(p), offset, params.sigmaDepth) *
                        normalWeight(guides(p), guides(q), params.sigmaNormal) *
                        luminanceWeight(luminanceAt(p), luminanceAt(q), variance,
                                        params.sigmaLuminance);
                    const double w = share(kernel, k) * (q == p ? 1.0 : stops);
                    sum += w * glm::dvec3(image(q));
                    squares += w * w * double(image(q).a);
                    total += w;
                }
            result(p) = glm::dvec4(sum / total, squares / (total * total));
        }
    return result;
}

/// One a-trous iteration over the picture. Schied et al. 2017, section 4.4.
inline Image<glm::dvec4> atrous(const Image<glm::vec4>& signal, const Image<glm::vec4>& guides,
                                const Image<glm::vec2>& slope, Kernel kernel,
                                const gpu::EdgeStopping& params) {
    const auto luminanceAt = [&](glm::ivec2 p) { return luminance(glm::dvec3(signal(p))); };
    return atrousIteration(signal, guides, slope, kernel, params, luminanceAt, 1);
}

} // namespace afterglow::reference
