// SPDX-License-Identifier: MIT
#pragma once

#include "app/bench/figures.h"

#include <string>
#include <vector>

namespace afterglow {

/// Two measurements of the same figures, held against each other.
struct FigureComparison {
    struct Row {
        std::string key, unit;
        double before = 0.0, after = 0.0; ///< medians
        double ratio = 1.0;               ///< after / before
        bool worse = false;               ///< by more than the bound
        bool isTime = false;
    };
    std::vector<Row> rows;                          ///< of the keys that both have
    std::vector<std::string> onlyBefore, onlyAfter; ///< keys that the other lacks
    double boundPercent = 0.0;

    /// Returns the rows of times that are worse, the worst first.
    std::vector<Row> slower() const;
};

/// Compares by key. A figure is worse if its median has moved by more than `boundPercent` of the
/// smaller of both in the direction that is not better; figures without a direction never are.
FigureComparison compareFigures(const Figures& before, const Figures& after, double boundPercent);

/// Returns a table with a row for each figure; worse ones are marked.
std::string tableOf(const FigureComparison& comparison);

} // namespace afterglow
