#include "app/report/metrics_file.h"

#include "renderer/base/error.h"
#include "renderer/base/file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace afterglow {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kMostFrames = 100000;

template <class Number>
std::optional<Number> numberIn(std::string_view text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size())
        return {};
    return number;
}

Json asJson(double value) {
    if (std::isnan(value))
        return nullptr;
    if (std::isinf(value))
        return value > 0 ? "inf" : "-inf";
    return value;
}

/// The four fields of a line; none if it has more or fewer.
std::optional<std::array<std::string_view, 4>> fieldsOf(std::string_view line) {
    std::array<std::string_view, 4> fields;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t comma = std::min(line.find(','), line.size());
        if ((comma == line.size()) != (i == 3))
            return {};
        fields[i] = line.substr(0, comma);
        line.remove_prefix(std::min(comma + 1, line.size()));
    }
    return fields;
}

} // namespace

Json readMetrics(const std::filesystem::path& file, const std::vector<std::string>& variants) {
    const std::string text = readFile(file);
    int number = 0;
    const auto refuse = [&](const std::string& cause) {
        throw InputError(file.string() + ":" + std::to_string(number) + ": " + cause);
    };

    Json metrics = Json::object();
    for (const std::string& variant : variants)
        metrics[variant] = Json::object();
    std::string_view rest = text;
    do {
        ++number;
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        const std::string_view line = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        if (number == 1) {
            if (line != "variant,frame,metric,value")
                refuse("expected the heading \"variant,frame,metric,value\"");
            continue;
        }
        const auto fields = fieldsOf(line);
        if (!fields)
            refuse("expected four fields: variant,frame,metric,value");
        const auto& [variant, frameText, metric, valueText] = *fields;
        if (std::ranges::find(variants, variant) == variants.end())
            refuse("no variant of the experiment is named \"" + std::string(variant) + "\"");
        const auto frame = numberIn<int>(frameText);
        if (!frame || *frame < 0 || *frame >= kMostFrames)
            refuse("expected a frame, found \"" + std::string(frameText) + "\"");
        const auto value = valueText.empty() ? std::optional(std::nan("")) // nothing was measured
                                             : numberIn<double>(valueText);
        if (!value)
            refuse("expected a number, found \"" + std::string(valueText) + "\"");

        Json& series = metrics[std::string(variant)][std::string(metric)];
        if (series.is_null())
            series = {{"first", *frame}, {"values", Json::array()}};
        Json& values = series["values"];
        const int next = series["first"].get<int>() + int(values.size());
        if (*frame < next)
            refuse("frame " + std::string(frameText) + " is not later than the one before");
        for (int gap = next; gap < *frame; ++gap)
            values.push_back(nullptr);
        values.push_back(asJson(*value));
    } while (!rest.empty());
    return metrics;
}

} // namespace afterglow
