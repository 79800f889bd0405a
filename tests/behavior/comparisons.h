// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/image/metrics.h"
#include "tests/support/sequence.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

namespace afterglow::test {

/// Checks that raw signal, histories and filtered signal have the same bits.
inline void checkEqualOutputs(const Sequence& a, const Sequence& b) {
    CHECK(differingPixels(a.targets().signals[0].raw.current().read<glm::vec4>(),
                          b.targets().signals[0].raw.current().read<glm::vec4>()) == 0);
    CHECK(differingPixels(imageOf(a.targets(), svgf::kMoments).read<glm::vec4>(),
                          imageOf(b.targets(), svgf::kMoments).read<glm::vec4>()) == 0);
    CHECK(differingPixels(imageOf(a.targets(), svgf::kColor).read<glm::vec4>(),
                          imageOf(b.targets(), svgf::kColor).read<glm::vec4>()) == 0);
    CHECK(differingPixels(a.signal(), b.signal()) == 0);
}

struct Settled {
    double rmse, flicker; ///< against the converged image; mean deviation over time
};

/// Measures the luminance of 16 further frames of a sequence in which nothing changes.
inline Settled settledOf(Sequence& sequence, const Image<float>& truth) {
    constexpr int kWindow = 16;
    std::vector<double> sum(truth.pixels().size()), squares(sum.size());
    Settled result{0.0, 0.0};
    for (int i = 0; i < kWindow; ++i) {
        sequence.next();
        const Image<float> frame = luminanceOf(sequence.signal());
        double error = 0.0;
        for (std::size_t k = 0; k < sum.size(); ++k) {
            const double value = frame.pixels()[k];
            error += std::pow(value - truth.pixels()[k], 2.0);
            sum[k] += value;
            squares[k] += value * value;
        }
        result.rmse += std::sqrt(error / double(sum.size())) / kWindow;
    }
    for (std::size_t k = 0; k < sum.size(); ++k)
        result.flicker +=
            std::sqrt(std::max(0.0, squares[k] / kWindow - std::pow(sum[k] / kWindow, 2.0))) /
            double(sum.size());
    MESSAGE(std::string(nameOf(sequence.settings.filter)), ": settled RMSE ", result.rmse,
            ", flicker ", result.flicker);
    return result;
}

} // namespace afterglow::test
