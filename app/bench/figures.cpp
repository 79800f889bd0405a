// SPDX-License-Identifier: MIT
#include "app/bench/figures.h"

#include "app/base/json_reader.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

namespace afterglow {

namespace {

constexpr std::array<std::string_view, 3> kBetterNames{"less", "more", "none"}; // by Better

} // namespace

void Figures::add(std::string_view subject, std::string_view name, std::string_view unit,
                  Better better, const Spread& value) {
    std::string key(subject);
    key += subject.empty() ? "" : "/";
    key += name;
    if (find(key))
        throw std::logic_error("the figure " + key + " was measured twice");
    figures_.push_back({std::move(key), std::string(unit), better, value});
}

const Figure* Figures::find(std::string_view key) const {
    const auto found = std::ranges::find(figures_, key, &Figure::key);
    return found == figures_.end() ? nullptr : &*found;
}

nlohmann::ordered_json describe(const Figures& figures) {
    nlohmann::ordered_json all = nlohmann::ordered_json::object();
    for (const Figure& figure : figures.all())
        all[figure.key] = {{"unit", figure.unit},
                           {"better", kBetterNames[std::size_t(figure.better)]},
                           {"median", figure.value.median},
                           {"lower_quartile", figure.value.lower},
                           {"upper_quartile", figure.value.upper},
                           {"n", figure.value.n}};
    return all;
}

BenchFile readBenchFile(std::string_view text, std::string_view source) {
    constexpr double kMost = std::numeric_limits<double>::max();
    const JsonDocument document(text, source);
    const JsonReader root = document.root();
    const std::int64_t schema = root.at("schema").wholeNumber(0, 1'000'000);
    if (schema != kBenchSchema)
        root.at("schema").refuse("the figures are of schema " + std::to_string(schema) +
                                 "; this program reads schema " + std::to_string(kBenchSchema));
    BenchFile file;
    file.machine = root.at("machine").at("cpu").text() + ", " +
                   root.at("gl").at("renderer").text() + ", " +
                   std::to_string(root.at("tracing_threads").wholeNumber(1, 1 << 20)) + " threads";
    for (const auto& [key, figure] : root.at("figures").members()) {
        figure.expectKeys({"unit", "better", "median", "lower_quartile", "upper_quartile", "n"});
        const Spread value{
            .median = figure.at("median").number(-kMost, kMost),
            .lower = figure.at("lower_quartile").number(-kMost, kMost),
            .upper = figure.at("upper_quartile").number(-kMost, kMost),
            .n = std::size_t(figure.at("n").wholeNumber(1, std::numeric_limits<int>::max()))};
        file.figures.add("", key, figure.at("unit").text(),
                         Better(figure.at("better").choice(kBetterNames)), value);
    }
    return file;
}

} // namespace afterglow
