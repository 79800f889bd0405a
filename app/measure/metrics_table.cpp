// SPDX-License-Identifier: MIT
#include "app/measure/metrics_table.h"

#include "app/measure/metric.h"
#include "renderer/base/error.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>

namespace afterglow {
namespace {

constexpr std::string_view kHead = "variant,frame,metric,value";

std::string written(double value) {
    return fmt::format("{:.9g}", value);
}

/// Cuts off the text before the next comma.
std::string_view nextCell(std::string_view& line) {
    const std::size_t end = std::min(line.find(','), line.size());
    const std::string_view cell = line.substr(0, end);
    line.remove_prefix(std::min(end + 1, line.size()));
    return cell;
}

} // namespace

void MetricsTable::add(std::string_view variant, int frame, std::string_view metric, double value) {
    if (!metricNamed(metric).isOfFrames())
        throw std::logic_error(std::string(metric) + " is a metric of runs, not of frames");
    rows_.push_back({std::string(variant), frame, std::string(metric),
                     std::strtod(written(value).c_str(), nullptr)});
}

void MetricsTable::append(const MetricsTable& other) {
    rows_.insert(rows_.end(), other.rows_.begin(), other.rows_.end());
}

std::vector<std::optional<double>> MetricsTable::curve(std::string_view variant,
                                                       std::string_view metric, int frames) const {
    std::vector<std::optional<double>> curve(std::size_t(std::max(frames, 0)));
    for (const Row& row : rows_)
        if (row.metric == metric && row.variant == variant && row.frame < frames)
            curve[std::size_t(row.frame)] = row.value;
    return curve;
}

std::string MetricsTable::csv(const std::vector<std::string>& variants) const {
    std::vector<const Row*> sorted;
    for (const Row& row : rows_)
        sorted.push_back(&row);
    const auto place = [&](const Row& row) {
        return std::pair(std::ranges::find(variants, row.variant) - variants.begin(), row.frame);
    };
    std::ranges::stable_sort(sorted,
                             [&](const Row* a, const Row* b) { return place(*a) < place(*b); });
    std::string text = std::string(kHead) + "\n";
    for (const Row* row : sorted)
        text += fmt::format("{},{},{},{}\n", row->variant, row->frame, row->metric,
                            written(row->value));
    return text;
}

MetricsTable MetricsTable::parse(std::string_view csv, std::string_view source) {
    MetricsTable table;
    for (int number = 1; number == 1 || !csv.empty(); ++number) {
        const std::size_t end = std::min(csv.find('\n'), csv.size());
        std::string_view line = csv.substr(0, end);
        csv.remove_prefix(std::min(end + 1, csv.size()));
        const auto refuse = [&] {
            throw InputError(fmt::format("{}:{}: not a row of \"{}\"", source, number, kHead));
        };
        if (number == 1) {
            if (line != kHead)
                refuse();
            continue;
        }
        Row row;
        row.variant = nextCell(line);
        const std::string_view frame = nextCell(line);
        row.metric = nextCell(line);
        const std::string value(line);
        char* parsed = nullptr;
        row.value = std::strtod(value.c_str(), &parsed);
        const auto [stop, error] =
            std::from_chars(frame.data(), frame.data() + frame.size(), row.frame);
        if (row.variant.empty() || row.metric.empty() || value.empty() || *parsed != '\0' ||
            error != std::errc() || stop != frame.data() + frame.size() || row.frame < 0)
            refuse();
        table.rows_.push_back(std::move(row));
    }
    return table;
}

} // namespace afterglow
