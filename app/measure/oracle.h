// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/image/metrics.h"

#include <optional>

namespace afterglow {

// What the filter would do if it knew the truth. Everything is of the luminance of the demodulated
// signal, which is what the filter sees.

/// lambda* per stratum of 3x3 pixels.
struct StrataTruth {
    Image<float> lambda;
    Mask lit; ///< strata with so much light now or before that lambda means something
};

/// lambda* is |sum E f_i - sum E f_{i-1}| / sum max(E f_i, E f_{i-1}) over the stratum's pixels
/// that count, or 0 where the stratum is not lit: the mean of the maxima is not above `floor`.
/// `now` and `before` are converged images of the same surfaces, those of frame i, in the light of
/// frame i and of frame i - 1. So no surface has to be found again between two images, and where
/// nothing changed the two are equal and lambda* is exactly 0.
StrataTruth idealLambda(const Image<float>& now, const Image<float>& before, const Mask& counts,
                        float floor);

/// alpha* = e^2 / (e^2 + s^2): the weight of the newest sample that leaves the least expected
/// error, where e is the error that the history has and s^2 the variance of a new sample. 0 where
/// the history is right (to 1e-4 of its value), 1 where a new sample is; 1 also where there is no
/// history. `history` is the luminance that was fetched, `truth` the converged one, `variance` that
/// of one sample.
Image<float> idealAlpha(const Image<float>& history, const Image<float>& truth,
                        const Image<float>& variance, const Mask& hasHistory);

/// How a weight in [0, 1] agrees with its ideal, over the pixels or strata that count.
struct Agreement {
    double mean = 0.0, idealMean = 0.0;
    double bias = 0.0; ///< mean of the difference: > 0 where there is more than ideal
    double rmse = 0.0;
};
Agreement compareWeights(const Image<float>& weight, const Image<float>& ideal, const Mask& counts);

/// Strata at which at least this much of the light changes are "changed", in lambda and lambda*.
inline constexpr float kChanged = 0.1f;

/// lambda as a detector of change.
struct Detection {
    std::optional<double> precision; ///< of those taken for changed, the share that has; none taken
    std::optional<double> recall;    ///< of those that have changed, the share found; none has
    std::optional<double> falseMean; ///< mean lambda where lambda* is 0; there is no such place
};
Detection detect(const Image<float>& lambda, const Image<float>& ideal, const Mask& counts);

} // namespace afterglow
