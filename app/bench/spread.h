// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace afterglow {

/// The median and the quartiles of what was measured more than once.
struct Spread {
    double median = 0.0, lower = 0.0, upper = 0.0;
    std::size_t n = 0; ///< measurements; 1 of what is counted and not measured

    bool operator==(const Spread&) const = default;
};

/// Returns the spread of some values, in any order. A quantile between two values is on the line
/// between them. All zero of none.
Spread spreadOf(std::vector<double> values);

/// Returns the spread of what has one value.
Spread exactly(double value);

/// Returns the spread of `amount` / x, of which a smaller x makes a larger value.
Spread rateOf(double amount, const Spread& x);

} // namespace afterglow
