// SPDX-License-Identifier: MIT
#include "tests/support/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace afterglow::detail {

namespace {

constexpr std::size_t kShown = 10;

struct Miss {
    std::size_t pixel;
    double difference; ///< the largest of the components
    double excess;     ///< over what is allowed, as a multiple of it
};

double differenceOf(double actual, double expected) {
    if (actual == expected)
        return 0.0; // also for infinities
    const double difference = std::abs(actual - expected);
    return std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference;
}

void printPlace(std::ostream& out, const Numbers& numbers, std::size_t pixel) {
    const auto width = std::size_t(numbers.size.x);
    if (numbers.isPicture)
        out << "(" << pixel % width << ", " << pixel / width << ")";
    else
        out << "[" << pixel << "]";
}

void printValue(std::ostream& out, const Numbers& numbers, std::size_t pixel) {
    const auto components = std::size_t(numbers.components);
    for (std::size_t c = 0; c < components; ++c)
        out << (c ? ", " : "") << numbers.values[pixel * components + c];
}

} // namespace

Comparison compareNumbers(const Numbers& actual, const Numbers& expected, Tolerance tolerance) {
    std::ostringstream out;
    out.precision(9);
    if (actual.size != expected.size || actual.components != expected.components) {
        out << "the actual is " << actual.size.x << " x " << actual.size.y << " of "
            << actual.components << " components, the expected " << expected.size.x << " x "
            << expected.size.y << " of " << expected.components;
        return {false, std::numeric_limits<double>::infinity(), out.str()};
    }

    const auto components = std::size_t(actual.components);
    double largest = 0.0;
    std::vector<Miss> misses;
    for (std::size_t pixel = 0; pixel < actual.values.size() / components; ++pixel) {
        Miss miss{pixel, 0.0, 0.0};
        for (std::size_t i = pixel * components; i < (pixel + 1) * components; ++i) {
            const double difference = differenceOf(actual.values[i], expected.values[i]);
            const double allowed =
                tolerance.max + tolerance.relative * std::abs(expected.values[i]);
            largest = std::max(largest, difference);
            // Not (difference <= allowed): an expected NaN makes `allowed` NaN too.
            if (difference > 0.0 && !(difference <= allowed)) {
                miss.difference = std::max(miss.difference, difference);
                miss.excess = std::max(miss.excess,
                                       allowed > 0.0 ? difference / allowed : 1e300 * difference);
            }
        }
        if (miss.difference > 0.0)
            misses.push_back(miss);
    }

    out << "largest difference " << largest << "; " << misses.size() << " of "
        << actual.values.size() / components << " differ by more than " << tolerance.max;
    if (tolerance.relative > 0.0)
        out << " + " << tolerance.relative << " of the expected";
    const auto shown = std::ptrdiff_t(std::min(kShown, misses.size()));
    std::ranges::partial_sort(misses, misses.begin() + shown, std::greater{}, &Miss::excess);
    for (const Miss& miss : std::ranges::subrange(misses.begin(), misses.begin() + shown)) {
        out << "\n    ";
        printPlace(out, actual, miss.pixel);
        out << " is (";
        printValue(out, actual, miss.pixel);
        out << "), expected (";
        printValue(out, expected, miss.pixel);
        out << "), off by " << miss.difference;
    }
    return {misses.empty(), largest, out.str()};
}

} // namespace afterglow::detail

namespace afterglow {

double meanOf(const Image<glm::u8vec4>& picture) {
    double sum = 0.0;
    for (const glm::u8vec4& p : picture.pixels())
        sum += double(p.r) + double(p.g) + double(p.b);
    return sum / (3.0 * double(picture.pixels().size()));
}

} // namespace afterglow
