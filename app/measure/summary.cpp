#include "app/measure/summary.h"

#include "app/measure/response.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

namespace afterglow {

namespace {

using Json = nlohmann::ordered_json;
using Curve = std::vector<std::optional<double>>;

template <class T>
Json orNull(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

/// The values of a range of frames that are there and finite.
std::vector<double> valuesIn(const Curve& curve, FrameRange range) {
    std::vector<double> values;
    for (int frame = std::max(0, range.first); frame < range.end; ++frame)
        if (const auto& value = curve[std::size_t(frame)]; value && std::isfinite(*value))
            values.push_back(*value);
    return values;
}

std::optional<double> meanIn(const Curve& curve, FrameRange range) {
    const std::vector<double> values = valuesIn(curve, range);
    if (values.empty())
        return std::nullopt;
    return settledValue(values, int(values.size()));
}

/// The measures of one variant.
class Sheet {
public:
    Sheet(const Experiment& experiment, const RunPlan& plan, const MetricsTable& table,
          const std::string& variant)
        : experiment_(experiment), plan_(plan), table_(table), variant_(variant) {}

    Json describe() const;

private:
    Curve curve(std::string_view metric) const {
        return table_.curve(variant_, metric, experiment_.frames());
    }
    Json ofEvent(const RunEvent& event) const;
    void addResponse(Json& json, const RunEvent& event) const;
    Json whileChanging(std::string_view metric) const;

    const Experiment& experiment_;
    const RunPlan& plan_;
    const MetricsTable& table_;
    const std::string& variant_;
};

void Sheet::addResponse(Json& json, const RunEvent& event) const {
    const FrameRange after{event.change.first, event.end};
    const int window = experiment_.settledWindow;
    const std::vector<double> p = valuesIn(curve("response"), after);
    const bool hasResponse = int(p.size()) == after.frames();
    const auto add = [&](const std::string& prefix, const std::string& area,
                         const std::optional<ResponseSummary>& response) {
        const auto of = [&](auto member) {
            return response ? orNull((*response).*member) : Json(nullptr);
        };
        json[prefix + "t50"] = of(&ResponseSummary::t50);
        json[prefix + "t90"] = of(&ResponseSummary::t90);
        json[prefix + "t99"] = of(&ResponseSummary::t99);
        json[area] = response ? Json(response->ghostFrames) : Json(nullptr);
        return response;
    };
    const auto response = hasResponse ? std::optional(summarize(p)) : std::nullopt;
    add("", "ghost_frames", response);
    json["overshoot"] = response ? Json(response->overshoot) : Json(nullptr);

    const auto start =
        meanIn(curve("response_before"), {event.change.first - window, event.change.first});
    std::optional<ResponseSummary> own;
    json["response_before"] = orNull(start);
    json["response_settled"] = hasResponse ? Json(settledValue(p, window)) : Json(nullptr);
    if (hasResponse && start)
        if (const auto values = betweenOwnValues(p, *start, settledValue(p, window)))
            own = summarize(*values);
    add("lag_", "lag_frames", own);

    const std::vector<double> noise = valuesIn(curve("noise"), after);
    const bool hasNoise = !noise.empty() && noise.size() == p.size();
    json["noise_after_event"] = orNull(
        meanIn(curve("noise"), {after.first, std::min(after.first + kNoiseFrames, after.end)}));
    json["noise_settle_frames"] =
        hasNoise ? orNull(framesUntilSettled(noise, settledValue(noise, window))) : Json(nullptr);
}

Json Sheet::ofEvent(const RunEvent& event) const {
    Json json{{"frame", event.change.first}, {"text", event.text}};
    const int window = experiment_.settledWindow;
    if (event.kind == RunEvent::Kind::Step) {
        addResponse(json, event);
    } else {
        json["until"] = event.change.end;
        for (const char* metric : {"rmse", "flip", "temporal_error"})
            json[std::string(metric) + "_moving"] = orNull(meanIn(curve(metric), event.change));
    }
    const FrameRange shown{event.change.first,
                           std::min(event.end, event.change.end + kTrailFrames)};
    json["ghost_energy"] = orNull(meanIn(curve("ghost_energy"), shown));
    json["trail_response"] = orNull(meanIn(curve("trail_response"), shown));
    // From the end of the change until the error is no more than a tenth above what it settles at.
    const int still = event.change.end - 1;
    const std::vector<double> error = valuesIn(curve("rmse"), {still, event.end});
    json["recovery_frames"] = nullptr;
    if (!error.empty()) {
        // Nothing is told from an error of one percent of what it was: black settles at 0.
        std::vector<double> all = valuesIn(curve("rmse"), {event.change.first - 1, event.end});
        const double settled =
            std::max(1.1 * settledValue(error, window), 0.01 * std::ranges::max(all));
        std::vector<double> spare;
        for (const double value : error)
            spare.push_back(settled - value);
        if (int(error.size()) > window && settled > 0.0)
            json["recovery_frames"] = orNull(framesUntilAbove(spare, 0.0));
    }
    return json;
}

/// The mean over the frames in which light or scene change.
Json Sheet::whileChanging(std::string_view metric) const {
    const Curve values = curve(metric);
    std::vector<double> found;
    for (const Moment& moment : plan_.moments)
        if (moment.first > 0 && (moment.lightsChanged || moment.worldMoved))
            if (const auto& value = values[std::size_t(moment.first)]; value)
                found.push_back(*value);
    return found.empty() ? Json(nullptr) : Json(settledValue(found, int(found.size())));
}

Json Sheet::describe() const {
    Json json = Json::object();
    Json events = Json::array();
    for (const RunEvent& event : plan_.events)
        events.push_back(ofEvent(event));
    if (!events.empty())
        for (const auto& [key, value] : events.front().items())
            if (key != "frame" && key != "text" && key != "until")
                json[key] = value;
    for (const char* metric : {"rmse", "relmse", "psnr", "ssim", "flip", "temporal_error"})
        json[std::string(metric) + "_settled"] = orNull(meanIn(curve(metric), plan_.settled));
    json["flicker"] = orNull(meanIn(curve("flicker"), plan_.settled));
    const FrameRange all{0, experiment_.frames()};
    json["flip_mean"] = orNull(meanIn(curve("flip"), all));
    for (const char* metric : {"lambda_bias", "lambda_rmse", "lambda_precision", "lambda_recall",
                               "lambda_mean", "lambda_ideal_mean"})
        json[metric] = whileChanging(metric);
    json["lambda_false"] = orNull(meanIn(curve("lambda_false"), all));
    json["alpha_bias_settled"] = orNull(meanIn(curve("alpha_bias"), plan_.settled));
    json["alpha_rmse_settled"] = orNull(meanIn(curve("alpha_rmse"), plan_.settled));
    if (!plan_.events.empty()) {
        const int first = plan_.events.front().change.first;
        const FrameRange after{first, std::min(first + kNoiseFrames, plan_.events.front().end)};
        json["alpha_bias_after_event"] = orNull(meanIn(curve("alpha_bias"), after));
        json["alpha_rmse_after_event"] = orNull(meanIn(curve("alpha_rmse"), after));
    }
    json["rays_per_frame"] = orNull(meanIn(curve("rays"), all));
    json["invalid_values"] = orNull(meanIn(curve("invalid_values"), all));
    if (events.size() > 1)
        json["events"] = events;
    return json;
}

std::string cell(const Json& json, const char* key, const char* format) {
    const auto found = json.find(key);
    if (found == json.end())
        return "-";
    if (found->is_null()) {
        const std::string_view name = key;
        const char* area = name.starts_with("lag_t") ? "lag_frames"
                           : name.starts_with("t")   ? "ghost_frames"
                                                     : nullptr;
        return area && json.contains(area) && !json.at(area).is_null() ? "never" : "-";
    }
    char text[48];
    std::snprintf(text, sizeof text, format, found->get<double>());
    return text;
}

} // namespace

Json summaryOf(const Experiment& experiment, const RunPlan& plan, const MetricsTable& table) {
    Json variants = Json::object();
    for (const Variant& variant : experiment.variants) {
        variants[variant.name] = Sheet(experiment, plan, table, variant.name).describe();
        if (variant.sweep)
            variants[variant.name]["sweep"] = {{"variant", variant.sweep->variant},
                                               {"key", variant.sweep->key},
                                               {"value", variant.sweep->value}};
    }
    return {{"experiment", experiment.name}, {"variants", variants}};
}

std::string tableOf(const Json& summary, const Json& timing) {
    struct Column {
        const char *title, *key, *format;
    };
    constexpr Column kColumns[] = {
        {"t50", "t50", "%.0f"},
        {"t90", "t90", "%.0f"},
        {"t99", "t99", "%.0f"},
        {"lag t90", "lag_t90", "%.0f"},
        {"ghost frames", "ghost_frames", "%.2f"},
        {"ghost energy", "ghost_energy", "%.3f"},
        {"overshoot", "overshoot", "%+.3f"},
        {"noise after", "noise_after_event", "%.5f"},
        {"recovery", "recovery_frames", "%.0f"},
        {"rmse settled", "rmse_settled", "%.5f"},
        {"flip settled", "flip_settled", "%.4f"},
        {"flicker", "flicker", "%.5f"},
        {"mean", "mean", "%.3f"}, // of imported frames only
        {"lambda false", "lambda_false", "%.4f"},
    };
    std::vector<std::vector<std::string>> rows(1, {"variant"});
    const Json& variants = summary.at("variants");
    std::vector<const Column*> shown;
    for (const Column& column : kColumns) {
        const bool isThere = std::ranges::any_of(
            variants, [&](const Json& variant) { return variant.contains(column.key); });
        if (isThere)
            shown.push_back(&column);
    }
    for (const Column* column : shown)
        rows[0].push_back(column->title);
    rows[0].push_back("ms/frame");
    for (const auto& [name, variant] : variants.items()) {
        std::vector<std::string> row{name};
        for (const Column* column : shown)
            row.push_back(cell(variant, column->key, column->format));
        row.push_back(cell(timing.at("variants").at(name), "ms_per_frame", "%.2f"));
        rows.push_back(row);
    }
    std::string table;
    for (const auto& row : rows) {
        for (std::size_t column = 0; column < row.size(); ++column) {
            std::size_t width = 0;
            for (const auto& other : rows)
                width = std::max(width, other[column].size());
            const std::string padding(width - row[column].size(), ' ');
            table += column == 0 ? row[column] + padding : "  " + padding + row[column];
        }
        table += '\n';
    }
    return table;
}

} // namespace afterglow
