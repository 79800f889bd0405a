// SPDX-License-Identifier: MIT
#include "app/measure/summary.h"

#include "app/measure/metric.h"
#include "app/measure/response.h"

#include <algorithm>
#include <cmath>

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

/// Returns whether an aggregation describes events of this kind.
bool describes(Aggregation aggregation, RunEvent::Kind kind) {
    using enum Aggregation;
    if (kind == RunEvent::Kind::Step && aggregation >= TimeTo && aggregation <= SettleTime)
        return true;
    return (kind == RunEvent::Kind::Motion && aggregation == MotionMean) ||
           aggregation == TrailMean || aggregation == Recovery;
}

/// The metrics of one variant.
class VariantSummary {
public:
    VariantSummary(const Experiment& experiment, const RunOutline& outline,
                   const MetricsTable& table, const std::string& variant)
        : experiment_(experiment), outline_(outline), table_(table), variant_(variant) {}

    Json describe() const;

private:
    Curve curve(std::string_view metric) const {
        return table_.curve(variant_, metric, experiment_.frames());
    }
    /// Adds the number of a metric that describes the whole run; none of any other.
    void addOfRun(const Metric& metric, Json& json) const;
    Json ofEvent(const RunEvent& event) const;
    Json ofEvent(const Metric& metric, const RunEvent& event) const;
    Json ofResponse(const Metric& metric, const RunEvent& event, std::vector<double> values) const;
    Json recovery(const Curve& error, const RunEvent& event) const;

    const Experiment& experiment_;
    const RunOutline& outline_;
    const MetricsTable& table_;
    const std::string& variant_;
};

Json VariantSummary::ofResponse(const Metric& metric, const RunEvent& event,
                                std::vector<double> values) const {
    using enum Aggregation;
    const int window = experiment_.settledWindow, first = event.change.first;
    if (metric.aggregation == OwnTimeTo || metric.aggregation == OwnAreaAbove) {
        const auto start = meanIn(curve("response_before"), {first - window, first});
        const auto own =
            start ? betweenOwnValues(values, *start, settledValue(values, window)) : std::nullopt;
        if (!own)
            return nullptr;
        values = *own;
    }
    switch (metric.aggregation) {
    case TimeTo:
    case OwnTimeTo: return orNull(framesUntilAbove(values, metric.level));
    case AreaAbove:
    case OwnAreaAbove: return ghostFrames(values);
    case Overshoot: return std::ranges::max(values) - 1.0;
    case SettleTime: return orNull(framesUntilSettled(values, settledValue(values, window)));
    default: return settledValue(values, window);
    }
}

// From the end of the change until the error is no more than a tenth above what it settles at.
Json VariantSummary::recovery(const Curve& error, const RunEvent& event) const {
    const int window = experiment_.settledWindow;
    const std::vector<double> after = valuesIn(error, {event.change.end - 1, event.end});
    if (int(after.size()) <= window)
        return nullptr;
    // Nothing is told from an error of one percent of what it was: black settles at 0.
    const std::vector<double> all = valuesIn(error, {event.change.first - 1, event.end});
    const double settled =
        std::max(1.1 * settledValue(after, window), 0.01 * std::ranges::max(all));
    std::vector<double> spare;
    for (const double value : after)
        spare.push_back(settled - value);
    return settled > 0.0 ? orNull(framesUntilAbove(spare, 0.0)) : Json(nullptr);
}

Json VariantSummary::ofEvent(const Metric& metric, const RunEvent& event) const {
    const Curve values = curve(metric.of.empty() ? metric.key : metric.of);
    const FrameRange change = event.change, after{change.first, event.end};
    switch (metric.aggregation) {
    case Aggregation::MotionMean: return orNull(meanIn(values, change));
    case Aggregation::TrailMean:
        return orNull(
            meanIn(values, {after.first, std::min(after.end, change.end + kTrailFrames)}));
    case Aggregation::StepMean:
        return orNull(
            meanIn(values, {after.first, std::min(after.first + kNoiseFrames, after.end)}));
    case Aggregation::BeforeMean:
        return orNull(meanIn(values, {after.first - experiment_.settledWindow, after.first}));
    case Aggregation::Recovery: return recovery(values, event);
    default:
        std::vector<double> whole = valuesIn(values, after);
        return int(whole.size()) == after.frames() ? ofResponse(metric, event, std::move(whole))
                                                   : Json(nullptr);
    }
}

Json VariantSummary::ofEvent(const RunEvent& event) const {
    Json json{{"frame", event.change.first}, {"text", event.text}};
    if (event.kind == RunEvent::Kind::Motion)
        json["until"] = event.change.end;
    for (const Metric& metric : metrics())
        if (describes(metric.aggregation, event.kind))
            json[std::string(metric.key)] = ofEvent(metric, event);
    return json;
}

void VariantSummary::addOfRun(const Metric& metric, Json& json) const {
    const Curve values = curve(metric.of.empty() ? metric.key : metric.of);
    const auto add = [&](std::optional<double> value) {
        json[std::string(metric.key)] = orNull(value);
    };
    if (metric.aggregation == Aggregation::SettledMean)
        add(meanIn(values, outline_.settled));
    if (metric.aggregation == Aggregation::Mean)
        add(meanIn(values, {0, experiment_.frames()}));
    if (metric.aggregation == Aggregation::ChangeMean) {
        Curve changing;
        for (const int frame : outline_.changes)
            changing.push_back(values[std::size_t(frame)]);
        add(meanIn(changing, {0, int(changing.size())}));
    }
    if (metric.aggregation == Aggregation::EventMean && !outline_.events.empty()) {
        const RunEvent& event = outline_.events.front();
        const int first = event.change.first;
        add(meanIn(values, {first, std::min(first + kNoiseFrames, event.end)}));
    }
}

Json VariantSummary::describe() const {
    Json json = Json::object();
    Json events = Json::array();
    for (const RunEvent& event : outline_.events)
        events.push_back(ofEvent(event));
    if (!events.empty())
        for (const auto& [key, value] : events.front().items())
            if (key != "frame" && key != "text" && key != "until")
                json[key] = value;
    for (const Metric& metric : metrics())
        addOfRun(metric, json);
    if (events.size() > 1)
        json["events"] = events;
    return json;
}

} // namespace

Json summaryOf(const Experiment& experiment, const RunOutline& outline, const MetricsTable& table) {
    Json variants = Json::object();
    for (const Variant& variant : experiment.variants) {
        variants[variant.name] =
            VariantSummary(experiment, outline, table, variant.name).describe();
        if (variant.sweep)
            variants[variant.name]["sweep"] = {{"variant", variant.sweep->variant},
                                               {"key", variant.sweep->key},
                                               {"value", variant.sweep->value}};
    }
    return {{"experiment", experiment.name}, {"variants", variants}};
}

std::string tableOf(const Json& summary, const Json& timing) {
    const Json& variants = summary.at("variants");
    std::vector<std::vector<std::string>> rows(1, {"variant"});
    for (const auto& [name, variant] : variants.items())
        rows.push_back({name});
    for (const Metric& metric : metrics()) {
        const auto isOf = [&](const Json& variant) { return variant.contains(metric.key); };
        const bool isThere =
            metric.aggregation == Aggregation::Timing || std::ranges::any_of(variants, isOf);
        if (!(metric.shown & kConsole) || !isThere)
            continue;
        rows[0].emplace_back(metric.label);
        for (std::size_t row = 1; row < rows.size(); ++row) {
            const std::string& name = rows[row][0];
            rows[row].push_back(
                shownValue(metric, variants.at(name), timing.at("variants").at(name)));
        }
    }
    // Counts characters of UTF-8 text.
    const auto widthOf = [](const std::string& text) {
        return std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; });
    };
    std::string table;
    for (const auto& row : rows) {
        for (std::size_t column = 0; column < row.size(); ++column) {
            std::ptrdiff_t width = 0;
            for (const auto& other : rows)
                width = std::max(width, widthOf(other[column]));
            const std::string padding(std::size_t(width - widthOf(row[column])), ' ');
            table += column == 0 ? row[column] + padding : "  " + padding + row[column];
        }
        table += '\n';
    }
    return table;
}

} // namespace afterglow
