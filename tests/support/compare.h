// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/image/image.h"

#include <ranges>
#include <string>
#include <type_traits>
#include <vector>

namespace afterglow {

/// Values are close when they differ by at most max + relative * |expected|. NaN is close to
/// nothing.
struct Tolerance {
    double max = 0.0;
    double relative = 0.0;
};

struct Comparison {
    bool close;
    double largest;     ///< absolute difference; infinite where NaN is involved
    std::string report; ///< the largest difference, and the ten worst pixels when not close
};

namespace detail {

/// Pixels as rows of numbers, so that the comparison is compiled once.
struct Numbers {
    glm::ivec2 size{1};
    int components = 1;
    bool isPicture = false;
    std::vector<double> values;
};

template <class T>
requires std::is_arithmetic_v<T>
void append(Numbers& numbers, T value) {
    numbers.components = 1;
    numbers.values.push_back(double(value));
}
template <glm::length_t L, class T, glm::qualifier Q>
void append(Numbers& numbers, const glm::vec<L, T, Q>& value) {
    numbers.components = L;
    for (glm::length_t i = 0; i < L; ++i)
        numbers.values.push_back(double(value[i]));
}

template <class T>
Numbers numbersOf(const T& value) {
    Numbers numbers;
    append(numbers, value);
    return numbers;
}
template <std::ranges::sized_range Values>
Numbers numbersOf(const Values& values) {
    Numbers numbers;
    numbers.size = {int(std::ranges::size(values)), 1};
    for (const auto& value : values)
        append(numbers, value);
    return numbers;
}
template <class Pixel>
Numbers numbersOf(const Image<Pixel>& image) {
    Numbers numbers = numbersOf(image.pixels());
    numbers.size = image.size();
    numbers.isPicture = true;
    return numbers;
}

Comparison compareNumbers(const Numbers& actual, const Numbers& expected, Tolerance tolerance);

} // namespace detail

/// Returns the mean of red, green and blue over all pixels, in [0, 255].
double meanOf(const Image<glm::u8vec4>& picture);

/// Compares numbers, GLM vectors, ranges of either, and images; float and double go together.
template <class Actual, class Expected>
Comparison compare(const Actual& actual, const Expected& expected, Tolerance tolerance) {
    return detail::compareNumbers(detail::numbersOf(actual), detail::numbersOf(expected),
                                  tolerance);
}

} // namespace afterglow

/// Checks as in CHECK_CLOSE(actual, expected, Tolerance{.max = 1e-5}). Include doctest first or
/// after.
#define CHECK_CLOSE(...)                                                                           \
    do {                                                                                           \
        const ::afterglow::Comparison comparison_ = ::afterglow::compare(__VA_ARGS__);             \
        CHECK_MESSAGE(comparison_.close, comparison_.report);                                      \
    } while (false)
