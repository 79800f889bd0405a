#pragma once

#include <bit>
#include <optional>

#include "shared/bindings.h"
#include "tests/reference/atrous.h"

namespace afterglow::reference {

/// Strata that cover a picture of `size` pixels.
inline glm::ivec2 strataOf(glm::ivec2 size) {
    const int edge = int(gpu::kStratumSize);
    return (size + edge - 1) / edge;
}

struct GradientInputs {
    const Image<glm::vec4>& raw;
    const Image<glm::uvec4>& samples;
    const Image<glm::vec4>& guides;
    const Image<glm::vec2>& slope;
};
struct GradientResult {
    Image<glm::dvec4> gradient; ///< delta, Delta, mean luminance, variance of luminance
    Image<glm::vec4> guides;    ///< copies, so they compare bit by bit
    Image<glm::vec2> slope;
};

/// The gradient samples and the guides of the strata. Schied et al. 2018, section 4.2.
inline GradientResult gradient(const GradientInputs& in, const gpu::GradientParams& params = {}) {
    const glm::ivec2 strata = strataOf(in.raw.size());
    const int edge = int(gpu::kStratumSize);
    GradientResult out{Image<glm::dvec4>(strata), Image<glm::vec4>(strata),
                       Image<glm::vec2>(strata)};
    for (int sy = 0; sy < strata.y; ++sy)
        for (int sx = 0; sx < strata.x; ++sx) {
            const glm::ivec2 s{sx, sy};

            const glm::uvec4 sample = in.samples(s);
            if (sample.y != 0) {
                const int landing = int(sample.y) - 1;
                const glm::ivec2 pixel = edge * s + glm::ivec2(landing % edge, landing / edge);
                const double now = in.raw(pixel).a;
                const double before = std::bit_cast<float>(std::uint32_t(sample.x));
                const bool sizeAlone = params.magnitude == gpu::kGradientAbsolute;
                out.gradient(s).x = sizeAlone ? std::abs(now - before) : now - before;
                out.gradient(s).y = std::max(now, before);
            }

            double count = 0.0, sum = 0.0, squares = 0.0;
            std::optional<glm::ivec2> guide;
            for (int y = 0; y < edge; ++y)
                for (int x = 0; x < edge; ++x) {
                    const glm::ivec2 p = edge * s + glm::ivec2(x, y);
                    if (!in.raw.contains(p) || isBackground(in.guides(p)))
                        continue;
                    const double l = in.raw(p).a;
                    count += 1.0;
                    sum += l;
                    squares += l * l;
                    if (!guide)
                        guide = p;
                }
            if (!guide)
                continue;
            const double mean = sum / count;
            out.gradient(s).z = mean;
            out.gradient(s).w = std::max(0.0, squares / count - mean * mean);

            const glm::ivec2 center = glm::min(edge * s + edge / 2, in.raw.size() - 1);
            if (!isBackground(in.guides(center)))
                guide = center;
            out.guides(s) = in.guides(*guide);
            out.slope(s) = in.slope(*guide);
        }
    return out;
}

/// One a-trous iteration over the strata. Schied et al. 2018, section 4.3. A sigmaLuminance of 0
/// stands for no luminance stop.
inline Image<glm::dvec4> gradientAtrous(const Image<glm::vec4>& gradient,
                                        const Image<glm::vec4>& strataGuides,
                                        const Image<glm::vec2>& strataSlope, Kernel kernel,
                                        const gpu::EdgeStopping& params) {
    const bool stops = params.sigmaLuminance > 0.0f;
    const auto mean = [&](const glm::vec4& g) { return stops ? double(g.z) : 0.0; };
    return atrousIteration(gradient, strataGuides, strataSlope, kernel, params, mean,
                           int(gpu::kStratumSize));
}

/// The share of the signal that changed, in [0, 1]. Schied et al. 2018, section 4.3.
inline Image<double> lambda(const Image<glm::vec4>& gradient, const gpu::GradientParams& params) {
    Image<double> result(gradient.size());
    for (int y = 0; y < gradient.size().y; ++y)
        for (int x = 0; x < gradient.size().x; ++x) {
            const glm::dvec4 g(gradient({x, y}));
            if (params.forceLambda >= 0.0f)
                result({x, y}) = params.forceLambda;
            else if (g.y > double(params.deltaFloor))
                result({x, y}) = std::min(1.0, std::abs(g.x) / g.y);
        }
    return result;
}

} // namespace afterglow::reference
