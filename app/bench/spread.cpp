// SPDX-License-Identifier: MIT
#include "app/bench/spread.h"

#include <algorithm>
#include <cmath>

namespace afterglow {

namespace {

double quantile(const std::vector<double>& sorted, double part) {
    const double place = part * double(sorted.size() - 1);
    const auto below = std::size_t(std::floor(place));
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (place - double(below)) * (sorted[above] - sorted[below]);
}

} // namespace

Spread spreadOf(std::vector<double> values) {
    if (values.empty())
        return {};
    std::ranges::sort(values);
    return {.median = quantile(values, 0.5),
            .lower = quantile(values, 0.25),
            .upper = quantile(values, 0.75),
            .n = values.size()};
}

Spread exactly(double value) {
    return {.median = value, .lower = value, .upper = value, .n = 1};
}

Spread rateOf(double amount, const Spread& x) {
    const auto over = [&](double value) { return value > 0.0 ? amount / value : 0.0; };
    return {.median = over(x.median), .lower = over(x.upper), .upper = over(x.lower), .n = x.n};
}

} // namespace afterglow
