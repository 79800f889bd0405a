// SPDX-License-Identifier: MIT
#include "app/bench/text_table.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace afterglow {

TextTable::TextTable(std::vector<std::string> head) : rows_{std::move(head)} {}

void TextTable::add(std::vector<std::string> row) {
    if (row.size() != rows_.front().size())
        throw std::logic_error("a row of a table has another number of cells than its head");
    rows_.push_back(std::move(row));
}

std::string TextTable::text() const {
    std::vector<std::size_t> widths(rows_.front().size(), 0);
    for (const auto& row : rows_)
        for (std::size_t i = 0; i < row.size(); ++i)
            widths[i] = std::max(widths[i], row[i].size());
    std::string text;
    for (const auto& row : rows_) {
        std::string line = "  ";
        for (std::size_t i = 0; i < row.size(); ++i)
            line += i == 0 ? fmt::format("{:<{}}", row[i], widths[i])
                           : fmt::format("  {:>{}}", row[i], widths[i]);
        text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
}

std::string digits(double value) {
    const double size = std::abs(value);
    const int behind = size == 0.0 || size >= 100.0 ? 0
                       : size >= 10.0               ? 1
                       : size >= 1.0                ? 2
                       : size >= 0.1                ? 3
                                                    : 4;
    return fmt::format("{:.{}f}", value, behind);
}

std::string bytesText(double bytes) {
    if (bytes >= 1e9)
        return digits(bytes * 1e-9) + " GB";
    if (bytes >= 1e6)
        return digits(bytes * 1e-6) + " MB";
    return digits(bytes * 1e-3) + " kB";
}

} // namespace afterglow
