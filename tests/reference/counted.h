// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "renderer/image/image.h"
#include "shared/bindings.h"
#include "shared/denoise_params.h"

// The fetch of what is known per stratum, and the counted history: "Temporal accumulation" and
// "Counted history" in docs/pipeline.md.

namespace afterglow::reference {

/// A value known per stratum, between the centers of the four strata around pixel p, each by its
/// weight; `otherwise` where they have none.
template <class At, class Weight>
double bilinearOfStrata(glm::ivec2 strata, glm::ivec2 p, At at, Weight weight,
                        double otherwise = 0.0) {
    // Stratum s has its center at 3 s + 3/2, pixel p at p + 1/2.
    const glm::dvec2 position = (glm::dvec2(p) + 0.5 - 1.5) / 3.0;
    const glm::ivec2 corner(glm::floor(position));
    const glm::dvec2 part = position - glm::dvec2(corner);
    double sum = 0.0, total = 0.0;
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x) {
            const glm::ivec2 s = glm::clamp(corner + glm::ivec2(x, y), glm::ivec2(0), strata - 1);
            const double w = std::abs(1 - x - part.x) * std::abs(1 - y - part.y) * weight(s);
            sum += w * at(s);
            total += w;
        }
    return total > 0.0 ? sum / total : otherwise;
}

/// A value known per stratum, at pixel p, as lambdaFetch says. `weight` acts with kLambdaLight.
template <class At, class Weight>
double fetchOfStrata(glm::ivec2 strata, glm::ivec2 p, int fetch, At at, Weight weight) {
    const glm::ivec2 own = p / int(gpu::kStratumSize);
    if (fetch == gpu::kLambdaNearest)
        return at(own);
    if (fetch == gpu::kLambdaBilinear)
        return bilinearOfStrata(strata, p, at, [](glm::ivec2) { return 1.0; });
    double largest = 0.0, sum = 0.0, total = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const glm::ivec2 s = glm::clamp(own + glm::ivec2(x, y), glm::ivec2(0), strata - 1);
            const double w = (2.0 - std::abs(x)) * (2.0 - std::abs(y)) * weight(s);
            largest = std::max(largest, at(s));
            sum += w * at(s);
            total += w;
        }
    if (fetch == gpu::kLambdaMax)
        return largest;
    return total > 0.0 ? sum / total : 0.0;
}

/// A change of light; one texel a stratum.
struct ChangeImages {
    const Image<float>& lambda;
    const Image<glm::vec4>& change; ///< E, v, scale, weight
    std::uint32_t changed;
    const Image<glm::uvec4>& samples;
};

struct CountedHistory {
    glm::dvec3 color{0.0};
    glm::dvec2 moments{0.0};
    double samples = 0.0;   ///< N
    double newSample = 1.0; ///< w: what the newest sample counts for
};

/// Takes samples from the history at pixel p, which was fetched at `position`, for what is known of
/// a change there.
inline CountedHistory count(CountedHistory history, const ChangeImages& in,
                            const gpu::TemporalParams& params, glm::ivec2 p, glm::dvec2 position) {
    const glm::ivec2 strata = in.lambda.size();
    const glm::dvec2 part = position - glm::floor(position);
    const auto isBetween = [](double x) { return x > 1e-3 && x < 1.0 - 1e-3; };
    double& n = history.samples;
    if (isBetween(part.x) || isBetween(part.y))
        n = std::min(n, double(params.historyBetweenPixels));
    const double fetched = n; // N_f

    if (in.changed > 0 && n > 0.0) {
        if (double(in.changed) > 0.005 * strata.x * strata.y)
            n = std::min(n, double(params.historyDuringChange));
        const auto channel = [&](int i) {
            return [&in, i](glm::ivec2 s) { return double(in.change(s)[i]); };
        };
        const auto weight = channel(3);
        const double scale = bilinearOfStrata(strata, p, channel(2), weight, 1.0);
        const double lambda = fetchOfStrata(
            strata, p, params.lambdaFetch, [&](glm::ivec2 s) { return double(in.lambda(s)); },
            weight);
        const double bias = fetchOfStrata(strata, p, params.lambdaFetch, channel(0), weight);
        const double variance = std::clamp(
            bilinearOfStrata(strata, p, channel(1), [](glm::ivec2) { return 1.0; }), 0.05, 4.0);
        if (lambda > 0.0) {
            history.color *= scale;
            history.moments *= glm::dvec2(scale, scale * scale);
        }
        n /= 1.0 + n * double(params.reactivity) * bias / ((1.0001 - lambda) * variance);
    }

    const int edge = int(gpu::kStratumSize);
    const std::uint32_t landing = in.samples(p / edge).y;
    const glm::ivec2 inStratum = p % edge;
    const bool isSample = landing == std::uint32_t(1 + inStratum.x + edge * inStratum.y);
    if (params.countReusedOnce != 0 && isSample && fetched > 0.0)
        history.newSample = 1.0 - n / fetched;
    return history;
}

} // namespace afterglow::reference
