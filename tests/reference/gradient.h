// SPDX-License-Identifier: MIT
#pragma once

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
    const Image<glm::vec4>& previousRaw;
    const Image<glm::uvec4>& samples;
    const Image<glm::vec4>& guides;
};

/// Of each stratum delta, Delta, mean luminance, variance of luminance. Schied et al. 2018, section
/// 4.2.
inline Image<glm::dvec4> gradient(const GradientInputs& in,
                                  const gpu::GradientParams& params = {}) {
    const glm::ivec2 strata = strataOf(in.raw.size());
    const int edge = int(gpu::kStratumSize);
    Image<glm::dvec4> out(strata);
    for (int sy = 0; sy < strata.y; ++sy)
        for (int sx = 0; sx < strata.x; ++sx) {
            const glm::ivec2 s{sx, sy};

            const glm::uvec4 sample = in.samples(s);
            if (sample.y != 0) {
                const int landing = int(sample.y) - 1;
                const glm::ivec2 pixel = edge * s + glm::ivec2(landing % edge, landing / edge);
                const double now = in.raw(pixel).a;
                const glm::ivec2 source(int(sample.z & 0xffffu), int(sample.z >> 16));
                const double before = in.previousRaw(source).a;
                const bool sizeAlone = params.magnitude == gpu::kGradientAbsolute;
                out(s).x = sizeAlone ? std::abs(now - before) : now - before;
                out(s).y = std::max(now, before);
            }

            double count = 0.0, sum = 0.0, squares = 0.0;
            for (int y = 0; y < edge; ++y)
                for (int x = 0; x < edge; ++x) {
                    const glm::ivec2 p = edge * s + glm::ivec2(x, y);
                    if (!in.raw.contains(p) || isBackground(in.guides(p)))
                        continue;
                    const double l = in.raw(p).a;
                    count += 1.0;
                    sum += l;
                    squares += l * l;
                }
            if (count == 0.0)
                continue;
            const double mean = sum / count;
            out(s).z = mean;
            out(s).w = std::max(0.0, squares / count - mean * mean);
        }
    return out;
}

struct StrataResult { // copies, so they compare bit by bit
    Image<glm::vec4> guides;
    Image<glm::vec2> slope;
};

/// Guides and slope of each stratum: of its center pixel, or of its first one with a surface.
inline StrataResult strataGuides(const Image<glm::vec4>& guides, const Image<glm::vec2>& slope) {
    const glm::ivec2 strata = strataOf(guides.size());
    const int edge = int(gpu::kStratumSize);
    StrataResult out{Image<glm::vec4>(strata), Image<glm::vec2>(strata)};
    for (int sy = 0; sy < strata.y; ++sy)
        for (int sx = 0; sx < strata.x; ++sx) {
            const glm::ivec2 s{sx, sy};
            std::optional<glm::ivec2> chosen;
            for (int k = edge * edge; k-- > 0;) {
                const glm::ivec2 p = edge * s + glm::ivec2(k % edge, k / edge);
                if (guides.contains(p) && !isBackground(guides(p)))
                    chosen = p;
            }
            const glm::ivec2 center = glm::min(edge * s + edge / 2, guides.size() - 1);
            if (!isBackground(guides(center)))
                chosen = center;
            if (!chosen)
                continue;
            out.guides(s) = guides(*chosen);
            out.slope(s) = slope(*chosen);
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
    const auto mean = [&](glm::ivec2 s) { return stops ? double(gradient(s).z) : 0.0; };
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
