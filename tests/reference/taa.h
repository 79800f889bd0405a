// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

#include "renderer/image/image.h"
#include "shared/post_params.h"

// Temporal anti-aliasing in double precision: docs/pipeline.md, "Temporal anti-aliasing".

namespace afterglow::reference {

struct TaaInputs {
    const Image<glm::vec4>& color;
    const Image<glm::vec4>& guides;
    const Image<glm::vec4>& motion;
    const Image<glm::vec4>& history; ///< rgb; a: frames
    bool historyValid = true;
    double exposure = 1.0; ///< factor, in all
};

inline double lumaOf(const glm::dvec3& c) {
    return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}

/// Between colors and what is averaged.
struct TaaWeights {
    double exposure;
    bool weighted;

    glm::dvec3 weigh(const glm::dvec3& c) const {
        return weighted ? exposure * c / (1.0 + exposure * lumaOf(c)) : c;
    }
    glm::dvec3 unweigh(const glm::dvec3& w) const {
        return weighted ? w / (exposure * std::max(1e-4, 1.0 - lumaOf(w))) : w;
    }
};

/// Cubic convolution with a = -1/2 (Keys 1981).
inline double cubic(double x) {
    x = std::abs(x);
    if (x <= 1.0)
        return 1.5 * x * x * x - 2.5 * x * x + 1.0;
    return x < 2.0 ? -0.5 * x * x * x + 2.5 * x * x - 4.0 * x + 2.0 : 0.0;
}

inline glm::dvec3 yCoCg(const glm::dvec3& c) {
    return {(c.r + 2.0 * c.g + c.b) / 4.0, (c.r - c.b) / 2.0, (2.0 * c.g - c.r - c.b) / 4.0};
}

inline glm::dvec3 fromYCoCg(const glm::dvec3& c) {
    return {c.x + c.y - c.z, c.x + c.z, c.x - c.y - c.z};
}

inline glm::dvec4 taaAt(const TaaInputs& in, const gpu::TaaParams& params, glm::ivec2 p) {
    const glm::ivec2 size = in.color.size();
    const TaaWeights weights{in.exposure, params.weighted != 0};
    const auto inside = [&](glm::ivec2 q) { return glm::clamp(q, glm::ivec2(0), size - 1); };

    // The nearest surface of the nine; those outside are none.
    glm::ivec2 nearest = p;
    const auto depthOf = [&](glm::ivec2 q) {
        const double depth = in.guides(q).w;
        return depth > 0.0 ? depth : INFINITY;
    };
    for (int k = 0; k < 9; ++k) {
        const glm::ivec2 q = p + glm::ivec2(k % 3 - 1, k / 3 - 1);
        if (in.guides.contains(q) && depthOf(q) < depthOf(nearest))
            nearest = q;
    }
    const glm::dvec4 motion(in.motion(nearest));
    const glm::dvec2 place = glm::dvec2(p) + glm::dvec2(motion);
    const glm::ivec2 texel(glm::floor(place + 0.5));
    const glm::dvec3 newest(in.color(p));
    const double frames = in.historyValid && motion.w == 1.0 && in.history.contains(texel)
                              ? in.history(texel).a
                              : 0.0;
    if (frames == 0.0)
        return {newest, 1.0};

    const glm::ivec2 base(glm::floor(place));
    glm::dvec3 history(0.0), low(INFINITY), high(-INFINITY);
    for (int k = 0; k < 16; ++k) {
        const glm::ivec2 q = base + glm::ivec2(k % 4 - 1, k / 4 - 1);
        const glm::dvec2 away = glm::abs(glm::dvec2(q) - place);
        const glm::dvec3 c = weights.weigh(glm::dvec3(in.history(inside(q))));
        history += cubic(away.x) * cubic(away.y) * c;
        if (away.x < 1.0 && away.y < 1.0) {
            low = glm::min(low, c);
            high = glm::max(high, c);
        }
    }
    history = yCoCg(glm::clamp(history, low, high));

    glm::dvec3 mean(0.0), variance(0.0);
    for (int pass = 0; pass < 2; ++pass)
        for (int k = 0; k < 9; ++k) {
            const glm::ivec2 q = inside(p + glm::ivec2(k % 3 - 1, k / 3 - 1));
            const glm::dvec3 c = yCoCg(weights.weigh(glm::dvec3(in.color(q))));
            if (pass == 0)
                mean += c / 9.0;
            else
                variance += (c - mean) * (c - mean) / 9.0;
        }
    double most = 1.0;
    for (int k = 0; k < 3; ++k)
        most = std::max(most, std::abs(history[k] - mean[k]) /
                                  (double(params.clip) * std::sqrt(variance[k]) + 1e-5));
    history = mean + (history - mean) / most;

    const double alpha = std::max(double(params.blend), 1.0 / (frames + 1.0));
    const glm::dvec3 blended = (1.0 - alpha) * fromYCoCg(history) + alpha * weights.weigh(newest);
    return {weights.unweigh(blended), frames + 1.0};
}

inline Image<glm::dvec4> taa(const TaaInputs& in, const gpu::TaaParams& params) {
    Image<glm::dvec4> out(in.color.size());
    for (int y = 0; y < out.size().y; ++y)
        for (int x = 0; x < out.size().x; ++x)
            out({x, y}) = taaAt(in, params, {x, y});
    return out;
}

} // namespace afterglow::reference
