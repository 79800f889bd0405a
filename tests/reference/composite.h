// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

#include "shared/post_params.h"

// From the signal to the display: docs/pipeline.md, "Composite and tone map".

namespace afterglow::reference {

inline glm::dvec3 compose(const glm::dvec3& signal, const glm::dvec3& albedo,
                          const glm::dvec3& emission, bool isBackground,
                          const glm::dvec3& ambient) {
    return isBackground ? ambient : albedo * signal + emission;
}

/// IEC 61966-2-1.
inline double encode(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

/// Narkowicz 2015.
inline glm::dvec3 aces(const glm::dvec3& x) {
    glm::dvec3 out;
    for (int k = 0; k < 3; ++k)
        out[k] = x[k] * (2.51 * x[k] + 0.03) / (x[k] * (2.43 * x[k] + 0.59) + 0.14);
    return out;
}

/// The sigmoid of the one that is like AgX: from a place among the stops to the encoded value.
inline double agxSigmoid(double place) {
    const double pivot = 10.0 / 16.5, slope = 2.0;
    const bool above = place > pivot;
    const double power = above ? 3.25 : 3.0, end = above ? 1.0 - pivot : pivot;
    const double d = std::abs(place - pivot);
    const double bend = (std::pow(slope * end / 0.5, power) - 1.0) / std::pow(end, power);
    const double half = slope * d / std::pow(1.0 + bend * std::pow(d, power), 1.0 / power);
    return above ? 0.5 + half : 0.5 - half;
}

inline glm::dvec3 agx(const glm::dvec3& x) {
    const glm::dmat3 mixed = glm::transpose(glm::dmat3(0.842479, 0.0784336, 0.0792237, // rows
                                                       0.0423282, 0.878469, 0.0791661, //
                                                       0.0423757, 0.0784336, 0.879143));
    const glm::dvec3 inset = mixed * x;
    glm::dvec3 encoded;
    for (int k = 0; k < 3; ++k) {
        const double place =
            inset[k] > 0.0 ? (std::log2(inset[k] / 0.18) + 10.0) / 16.5 : 0.0; // of 16.5 stops
        encoded[k] = agxSigmoid(std::clamp(place, 0.0, 1.0));
    }
    const glm::dvec3 outset = glm::inverse(mixed) * encoded;
    glm::dvec3 out;
    for (int k = 0; k < 3; ++k)
        out[k] = std::pow(std::clamp(outset[k], 0.0, 1.0), 2.2);
    return out;
}

/// Khronos 2024.
inline glm::dvec3 neutral(const glm::dvec3& x) {
    const double least = std::min({x.r, x.g, x.b});
    const double reflected = least >= 0.08 ? 0.04 : least - least * least / 0.16;
    const glm::dvec3 color = x - reflected;
    const double peak = std::max({color.r, color.g, color.b});
    if (peak <= 0.76)
        return color;
    const double compressed = 1.0 - 0.24 * 0.24 / (peak - 0.76 + 0.24);
    const double kept = 1.0 / (0.15 * (peak - compressed) + 1.0);
    return kept * color * (compressed / peak) + (1.0 - kept) * glm::dvec3(compressed);
}

/// Linear light of the display, in [0, 1].
inline glm::dvec3 toneMap(int toneMapper, const glm::dvec3& x) {
    const glm::dvec3 mapped = toneMapper == gpu::kToneAces      ? aces(x)
                              : toneMapper == gpu::kToneAgx     ? agx(x)
                              : toneMapper == gpu::kToneNeutral ? neutral(x)
                                                                : x;
    return glm::clamp(mapped, 0.0, 1.0);
}

/// In [0, 255], not rounded.
inline glm::dvec3 display(const glm::dvec3& composed, double stops,
                          int toneMapper = gpu::kToneAces) {
    const glm::dvec3 mapped = toneMap(toneMapper, std::exp2(stops) * composed);
    glm::dvec3 out;
    for (int k = 0; k < 3; ++k)
        out[k] = 255.0 * encode(mapped[k]);
    return out;
}

} // namespace afterglow::reference
