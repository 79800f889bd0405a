// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

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

/// In [0, 255], not rounded.
inline glm::dvec3 display(const glm::dvec3& composed, double stops) {
    glm::dvec3 out;
    for (int k = 0; k < 3; ++k) {
        const double x = std::exp2(stops) * composed[k];
        const double f = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
        out[k] = 255.0 * encode(std::clamp(f, 0.0, 1.0));
    }
    return out;
}

} // namespace afterglow::reference
