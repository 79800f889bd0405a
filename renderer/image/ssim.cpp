// SPDX-License-Identifier: MIT
#include "renderer/image/ssim.h"

#include "renderer/image/separable_filter.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace afterglow {
namespace {

constexpr int kRadius = 5;          // of the window, in pixels
constexpr double kDeviation = 1.5;  // of the window, in pixels
constexpr double kC1 = 0.01 * 0.01; // (K1 L)^2 with the range of values L = 1
constexpr double kC2 = 0.03 * 0.03; // (K2 L)^2

Weights windowWeights() {
    Weights weights = weightsOf(
        kRadius, [](int i) { return std::exp(-0.5 * i * i / (kDeviation * kDeviation)); });
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (double& weight : weights)
        weight /= sum;
    return weights;
}

/// Returns the weighted mean of valueAt(i), i the index of a pixel, over the window of each pixel.
template <class ValueAt>
Image<double> windowMean(glm::ivec2 size, const Weights& weights, ValueAt valueAt) {
    Image<double> values(size);
    for (std::size_t i = 0; i < values.pixels().size(); ++i)
        values.pixels()[i] = valueAt(i);
    return filterColumns(filterRows(values, weights), weights);
}

/// Adds the similarity of one channel, times factor, to sums.
void addChannel(const Image<glm::u8vec4>& image, const Image<glm::u8vec4>& reference, int channel,
                double factor, Image<double>& sums) {
    const auto x = [&](std::size_t i) { return image.pixels()[i][channel] / 255.0; };
    const auto y = [&](std::size_t i) { return reference.pixels()[i][channel] / 255.0; };
    const Weights weights = windowWeights();
    const glm::ivec2 size = image.size();
    const Image<double> meanX = windowMean(size, weights, x);
    const Image<double> meanY = windowMean(size, weights, y);
    const Image<double> meanXX =
        windowMean(size, weights, [&](std::size_t i) { return x(i) * x(i); });
    const Image<double> meanYY =
        windowMean(size, weights, [&](std::size_t i) { return y(i) * y(i); });
    const Image<double> meanXY =
        windowMean(size, weights, [&](std::size_t i) { return x(i) * y(i); });
    for (std::size_t i = 0; i < sums.pixels().size(); ++i) {
        const double mx = meanX.pixels()[i], my = meanY.pixels()[i];
        const double varianceX = meanXX.pixels()[i] - mx * mx;
        const double varianceY = meanYY.pixels()[i] - my * my;
        const double covariance = meanXY.pixels()[i] - mx * my;
        sums.pixels()[i] += factor * (2.0 * mx * my + kC1) * (2.0 * covariance + kC2) /
                            ((mx * mx + my * my + kC1) * (varianceX + varianceY + kC2));
    }
}

/// Returns the pixels whose window lies within the image, and of a small image those in the middle.
Mask innerPixels(glm::ivec2 size) {
    const glm::ivec2 border = glm::min(glm::ivec2(kRadius), (size - 1) / 2);
    Mask inner(size, 0);
    for (int y = border.y; y < size.y - border.y; ++y)
        for (int x = border.x; x < size.x - border.x; ++x)
            inner({x, y}) = 1;
    return inner;
}

Mask pixelsThatCount(glm::ivec2 size, const Mask* mask) {
    Mask inner = innerPixels(size);
    if (!mask)
        return inner;
    std::transform(inner.pixels().begin(), inner.pixels().end(), mask->pixels().begin(),
                   inner.pixels().begin(),
                   [](std::uint8_t a, std::uint8_t b) { return std::uint8_t(a != 0 && b != 0); });
    return countOf(inner) > 0 ? inner : *mask;
}

} // namespace

MeasuredImage ssim(const Image<glm::u8vec4>& image, const Image<glm::u8vec4>& reference,
                   const Mask* mask) {
    if (image.size() != reference.size() || (mask && mask->size() != image.size()))
        throw std::logic_error("images to be compared, and their mask, must have one size");
    Image<double> sums(image.size());
    for (int channel = 0; channel < 3; ++channel)
        addChannel(image, reference, channel, 1.0 / 3.0, sums);

    MeasuredImage result{.map = Image<float>(image.size())};
    std::copy(sums.pixels().begin(), sums.pixels().end(), result.map.pixels().begin());
    const Mask counts = pixelsThatCount(image.size(), mask);
    result.mean = meanOf(result.map, &counts);
    return result;
}

} // namespace afterglow
