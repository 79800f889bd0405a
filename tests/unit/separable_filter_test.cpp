// SPDX-License-Identifier: MIT
#include "renderer/image/separable_filter.h"

#include "tests/support/compare.h"

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

Image<double> numbered(glm::ivec2 size) {
    Image<double> image(size);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            image({x, y}) = 100.0 * y + x * x;
    return image;
}

/// One pixel after the other, from the definition.
Image<double> expected(const Image<double>& image, const Weights& weights, glm::ivec2 axis) {
    const int radius = int(weights.size()) / 2;
    Image<double> result(image.size());
    for (int y = 0; y < image.size().y; ++y)
        for (int x = 0; x < image.size().x; ++x)
            for (int i = -radius; i <= radius; ++i)
                result({x, y}) +=
                    weights[std::size_t(i + radius)] *
                    image(glm::clamp(glm::ivec2(x, y) + i * axis, glm::ivec2(0), image.size() - 1));
    return result;
}

} // namespace

TEST_CASE("weights go from the pixel before to the pixel after, along rows and along columns") {
    const Image<double> image = numbered({4, 3});
    const Weights before{1.0, 0.0, 0.0};
    CHECK(filterRows(image, before)({2, 1}) == image({1, 1}));
    CHECK(filterColumns(image, before)({2, 1}) == image({2, 0}));
    CHECK(filterRows(image, before)({0, 1}) == image({0, 1})); // beyond the border, the nearest
    CHECK(filterColumns(image, before)({2, 0}) == image({2, 0}));
    CHECK(weightsOf(2, [](int i) { return 10.0 * i; }) == Weights{-20.0, -10.0, 0.0, 10.0, 20.0});
}

TEST_CASE("a filter along one axis is a weighted sum, in images of every width and for any reach") {
    const Weights few{0.5, -1.0, 0.25}, many = weightsOf(9, [](int i) { return 1.0 / (i + 10); });
    for (const Weights& weights : {few, many}) {
        for (const glm::ivec2 size : {glm::ivec2(1, 1), {5, 3}, {15, 9}, {16, 2}, {33, 21}}) {
            const Image<double> image = numbered(size);
            const Tolerance rounding{.relative = 1e-13};
            CHECK_CLOSE(filterRows(image, weights), expected(image, weights, {1, 0}), rounding);
            CHECK_CLOSE(filterColumns(image, weights), expected(image, weights, {0, 1}), rounding);
        }
    }
    CHECK(filterRows(Image<double>({0, 3}), few).size() == glm::ivec2(0, 3));
}
