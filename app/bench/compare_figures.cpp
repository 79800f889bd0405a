// SPDX-License-Identifier: MIT
#include "app/bench/compare_figures.h"

#include "app/bench/text_table.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace afterglow {

namespace {

/// Returns how many times worse it has become: above 1 is worse.
double worsening(const FigureComparison::Row& row, Better better) {
    if (row.before == row.after || better == Better::None)
        return 1.0;
    const double less = better == Better::Less ? row.before : row.after;
    const double more = better == Better::Less ? row.after : row.before;
    return less > 0.0 ? more / less : std::numeric_limits<double>::infinity();
}

} // namespace

FigureComparison compareFigures(const Figures& before, const Figures& after, double boundPercent) {
    FigureComparison comparison{
        .rows = {}, .onlyBefore = {}, .onlyAfter = {}, .boundPercent = boundPercent};
    for (const Figure& old : before.all()) {
        const Figure* const now = after.find(old.key);
        if (!now) {
            comparison.onlyBefore.push_back(old.key);
            continue;
        }
        FigureComparison::Row row{.key = old.key,
                                  .unit = old.unit,
                                  .before = old.value.median,
                                  .after = now->value.median,
                                  .isTime = old.isTime()};
        if (row.before != row.after)
            row.ratio = row.before != 0.0 ? row.after / row.before
                                          : std::numeric_limits<double>::infinity();
        row.worse = worsening(row, old.better) > 1.0 + boundPercent / 100.0;
        comparison.rows.push_back(std::move(row));
    }
    for (const Figure& now : after.all())
        if (!before.find(now.key))
            comparison.onlyAfter.push_back(now.key);
    return comparison;
}

std::vector<FigureComparison::Row> FigureComparison::slower() const {
    std::vector<Row> found;
    std::ranges::copy_if(rows, std::back_inserter(found),
                         [](const Row& row) { return row.worse && row.isTime; });
    std::ranges::stable_sort(found, [](const Row& a, const Row& b) {
        const auto factor = [](const Row& row) { return std::max(row.ratio, 1.0 / row.ratio); };
        return factor(a) > factor(b);
    });
    return found;
}

std::string tableOf(const FigureComparison& comparison) {
    TextTable table({"figure", "unit", "before", "after", "ratio", ""});
    for (const FigureComparison::Row& row : comparison.rows)
        table.add({row.key, row.unit, digits(row.before), digits(row.after),
                   fmt::format("{:.3f}", row.ratio), row.worse ? "worse" : ""});
    std::string text = table.text();
    for (const std::string& key : comparison.onlyBefore)
        text += "  only before: " + key + "\n";
    for (const std::string& key : comparison.onlyAfter)
        text += "  only after: " + key + "\n";
    return text;
}

} // namespace afterglow
