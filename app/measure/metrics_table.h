// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace afterglow {

/// Measures of frames in long form, as in metrics.csv: variant, frame, metric, value. A value is
/// kept with nine digits, as it is written, so that a table that was read gives what the one that
/// was written gave.
class MetricsTable {
public:
    /// The metric must be one of frames: see metric.h.
    void add(std::string_view variant, int frame, std::string_view metric, double value);
    /// All rows of another table of other frames or variants.
    void append(const MetricsTable& other);

    /// One value a frame; none where there is no row.
    std::vector<std::optional<double>> curve(std::string_view variant, std::string_view metric,
                                             int frames) const;
    struct Row {
        std::string variant;
        int frame;
        std::string metric;
        double value;
    };
    const std::vector<Row>& rows() const { return rows_; }

    /// Sorted by the order of `variants`, then by frame; rows of a frame stay in their order.
    std::string csv(const std::vector<std::string>& variants) const;
    /// InputError names `source` and the line that is no row.
    static MetricsTable parse(std::string_view csv, std::string_view source);

private:
    std::vector<Row> rows_;
};

} // namespace afterglow
