// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/image/image.h"

#include <vector>

namespace afterglow {

/// The weights of a filter along one axis: an odd number 2r + 1 of them, from the pixel r before to
/// the pixel r after.
using Weights = std::vector<double>;

/// Returns weightAt(i) for i = -radius, ..., radius.
template <class WeightAt>
Weights weightsOf(int radius, WeightAt weightAt) {
    Weights weights;
    for (int i = -radius; i <= radius; ++i)
        weights.push_back(weightAt(i));
    return weights;
}

/// Replaces each pixel by the weighted sum of its row, or column, around it. Beyond the border the
/// nearest pixel repeats.
Image<double> filterRows(const Image<double>& image, const Weights& weights);
Image<double> filterColumns(const Image<double>& image, const Weights& weights);

} // namespace afterglow
