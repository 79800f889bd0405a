// SPDX-License-Identifier: MIT
#include "renderer/image/separable_filter.h"

#include <algorithm>

namespace afterglow {
namespace {

/// Sums are made for this many pixels at once: a length that the compiler knows, so that it takes
/// vectors also at -O2.
constexpr int kBlock = 16;

/// Computes sums[x] = the sum over k of weights[k] * rowOf(k)[x], for x < width.
template <class RowOf>
void weightedSum(const Weights& weights, RowOf rowOf, int width, double* sums) {
    int first = 0;
    for (; first + kBlock <= width; first += kBlock) {
        double block[kBlock] = {};
        for (std::size_t k = 0; k < weights.size(); ++k) {
            const double weight = weights[k];
            const double* const values = rowOf(int(k)) + first;
            for (int i = 0; i < kBlock; ++i)
                block[i] += weight * values[i];
        }
        std::copy(block, block + kBlock, sums + first);
    }
    for (; first < width; ++first) {
        sums[first] = 0.0;
        for (std::size_t k = 0; k < weights.size(); ++k)
            sums[first] += weights[k] * rowOf(int(k))[first];
    }
}

const double* rowOf(const Image<double>& image, int y) {
    return image.pixels().data() + std::size_t(y) * std::size_t(image.size().x);
}

double* rowOf(Image<double>& image, int y) {
    return image.pixels().data() + std::size_t(y) * std::size_t(image.size().x);
}

} // namespace

Image<double> filterRows(const Image<double>& image, const Weights& weights) {
    const int width = image.size().x, radius = int(weights.size()) / 2;
    Image<double> result(image.size());
    if (result.pixels().empty())
        return result;
    std::vector<double> padded(std::size_t(width + 2 * radius));
    for (int y = 0; y < image.size().y; ++y) {
        const double* const row = rowOf(image, y);
        std::fill_n(padded.begin(), radius, row[0]);
        std::copy_n(row, width, padded.begin() + radius);
        std::fill_n(padded.begin() + radius + width, radius, row[width - 1]);
        weightedSum(
            weights, [&](int k) { return padded.data() + k; }, width, rowOf(result, y));
    }
    return result;
}

Image<double> filterColumns(const Image<double>& image, const Weights& weights) {
    const int last = image.size().y - 1, radius = int(weights.size()) / 2;
    Image<double> result(image.size());
    for (int y = 0; y <= last; ++y) {
        const auto neighbor = [&](int k) {
            return rowOf(image, std::clamp(y + k - radius, 0, last));
        };
        weightedSum(weights, neighbor, image.size().x, rowOf(result, y));
    }
    return result;
}

} // namespace afterglow
