#include "app/report/metrics_file.h"

#include "app/measure/metrics_table.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"

#include <algorithm>
#include <cmath>

namespace afterglow {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kMostFrames = 100000;

Json asJson(double value) {
    if (std::isnan(value))
        return nullptr;
    if (std::isinf(value))
        return value > 0 ? "inf" : "-inf";
    return value;
}

} // namespace

Json readMetrics(const std::filesystem::path& file, const std::vector<std::string>& variants) {
    const auto refuse = [&](const std::string& cause) {
        throw InputError(file.string() + ": " + cause);
    };
    const MetricsTable table = MetricsTable::parse(readFile(file), file.string());
    Json metrics = Json::object();
    for (const std::string& variant : variants)
        metrics[variant] = Json::object();
    for (const MetricsTable::Row& row : table.rows()) {
        if (std::ranges::find(variants, row.variant) == variants.end())
            refuse("no variant of the experiment is named \"" + row.variant + "\"");
        Json& series = metrics[row.variant][row.metric];
        if (series.is_null())
            series = {{"first", row.frame}, {"values", Json::array()}};
        Json& values = series["values"];
        const int next = series["first"].get<int>() + int(values.size());
        if (row.frame < next || row.frame >= kMostFrames)
            refuse("frame " + std::to_string(row.frame) + " of " + row.metric +
                   " is not later than the one before");
        for (int gap = next; gap < row.frame; ++gap)
            values.push_back(nullptr);
        values.push_back(asJson(row.value));
    }
    return metrics;
}

} // namespace afterglow
