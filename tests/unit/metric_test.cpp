// SPDX-License-Identifier: MIT
#include "app/measure/metric.h"
#include "app/measure/metrics_table.h"
#include "app/measure/summary.h"

#include <cmath>
#include <set>
#include <stdexcept>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace afterglow;
using Json = nlohmann::ordered_json;

namespace {

/// A summary of every metric of frames, with a step of light and then a motion in it.
Json summaryOfAll() {
    const Experiment experiment = parseExperiment(
        R"({"name": "made", "scene": "cornell", "frames": 40, "variants": ["asvgf"],
        "settledWindow": 4, "timeline": [{"frame": 10, "light": "key", "on": false},
        {"frame": 20, "until": 24, "node": "key", "by": [0.1, 0, 0]}]})",
        "made.json");
    MetricsTable table;
    for (int frame = 0; frame < experiment.frames(); ++frame)
        for (const Metric& metric : metrics())
            if (metric.isOfFrames())
                table.add("asvgf", frame, metric.key, frame < 10 ? 0.25 : 1.0);
    return summaryOf(experiment, outlineOf(stagedRun(experiment).plan), table)
        .at("variants")
        .at("asvgf");
}

} // namespace

TEST_CASE("every metric has a name of its own and says what it is") {
    std::set<std::string_view> keys;
    for (const Metric& metric : metrics()) {
        CAPTURE(metric.key);
        CHECK(keys.insert(metric.key).second);
        CHECK_FALSE(metric.label.empty());
        CHECK(metric.tip.ends_with("."));
        CHECK((metric.better == "" || metric.better == "low" || metric.better == "high"));
        CHECK(&metricNamed(metric.key) == &metric);
        if (!metric.of.empty())
            CHECK(metricNamed(metric.of).isOfFrames());
        if (!metric.reachedIf.empty())
            CHECK_FALSE(metricNamed(metric.reachedIf).isOfFrames());
        if (!metric.insteadOf.empty())
            CHECK_FALSE(metricNamed(metric.insteadOf).isOfFrames());
        // What a table shows is a number of runs.
        if (metric.shown != 0 || !metric.group.empty())
            CHECK(metric.aggregation != Aggregation::None);
    }
    CHECK(metricNamed("shadows:lambda_rmse").key == "lambda_rmse");
    CHECK_THROWS_AS(metricNamed("lambda"), std::logic_error);
    CHECK(metricsJson().size() == metrics().size());
}

TEST_CASE("only metrics of frames have values of frames") {
    MetricsTable table;
    table.add("svgf", 0, "shadows:lambda_rmse", 1.0);
    CHECK_THROWS_AS(table.add("svgf", 0, "rmze", 1.0), std::logic_error);
    CHECK_THROWS_AS(table.add("svgf", 0, "rmse_settled", 1.0), std::logic_error);
}

TEST_CASE("a summary holds each metric that is aggregated, and nothing else") {
    const Json summary = summaryOfAll();
    std::set<std::string> expected{"events"}, found;
    for (const Metric& metric : metrics())
        if (metric.aggregation != Aggregation::None && metric.aggregation < Aggregation::Timing &&
            metric.aggregation != Aggregation::MotionMean)
            expected.insert(std::string(metric.key));
    for (const auto& [key, value] : summary.items())
        found.insert(key);
    CHECK(found == expected);
    CHECK(summary.at("rmse_settled") == 0.25);
    CHECK(summary.at("t50") == 0);
    const Json& motion = summary.at("events").at(1);
    for (const Metric& metric : metrics())
        CHECK(motion.contains(metric.key) == (metric.aggregation == Aggregation::MotionMean ||
                                              metric.aggregation == Aggregation::TrailMean ||
                                              metric.aggregation == Aggregation::Recovery));
    CHECK(motion.at("rmse_moving") == 1.0);
}

TEST_CASE("what was not reached is never, and what was not measured is a dash") {
    const Metric &t90 = metricNamed("t90"), &ms = metricNamed("ms_per_frame");
    CHECK(shownValue(t90, {{"t90", 12}, {"ghost_frames", 4.0}}, {}) == "12");
    CHECK(shownValue(t90, {{"t90", nullptr}, {"ghost_frames", 4.0}}, {}) == "never");
    CHECK(shownValue(t90, {{"t90", nullptr}, {"ghost_frames", nullptr}}, {}) == "-");
    CHECK(shownValue(t90, Json::object(), {}) == "-");
    CHECK(shownValue(metricNamed("ghost_frames"), {{"ghost_frames", 4.0}}, {}) == "4.00");
    CHECK(shownValue(ms, Json::object(), {{"ms_per_frame", 12.34}}) == "12.3");
}

TEST_CASE("the columns of the printed table stand below their heads, in any alphabet") {
    const Json summary{{"variants",
                        {{"a", {{"t90", 3}, {"lambda_false", 0.5}}},
                         {"b", {{"t90", 11}, {"lambda_false", nullptr}}}}}};
    const Json times{
        {"variants", {{"a", {{"ms_per_frame", 1.0}}}, {"b", {{"ms_per_frame", 2.0}}}}}};
    CHECK(tableOf(summary, times) == "variant  t90  λ false   ms\n"
                                     "a          3   0.5000  1.0\n"
                                     "b         11        -  2.0\n");
}

TEST_CASE("an outline that is written and read again is the same") {
    const Experiment experiment = parseExperiment(
        R"({"name": "made", "scene": "cornell", "frames": 40, "variants": ["svgf"],
        "timeline": [{"frame": 10, "light": "key", "on": false},
        {"frame": 20, "until": 24, "node": "key", "by": [0.1, 0, 0]}]})",
        "made.json");
    const RunOutline outline = outlineOf(stagedRun(experiment).plan);
    REQUIRE(outline.events.size() == 2);
    CHECK(outline.changes == std::vector<int>{10, 20, 21, 22, 23});
    Json json;
    writeOutline(outline, json);
    for (const FrameRange& range : outline.references)
        json["references"].push_back({{"first", range.first}, {"end", range.end}});
    const JsonDocument document(json.dump(), "experiment.json");
    const RunOutline again = readOutline(document.root(), experiment.frames());
    CHECK(again.settled == outline.settled);
    CHECK(again.pictures == outline.pictures);
    CHECK(again.changes == outline.changes);
    CHECK(again.references == outline.references);
    REQUIRE(again.events.size() == outline.events.size());
    for (std::size_t i = 0; i < again.events.size(); ++i) {
        CHECK(again.events[i].kind == outline.events[i].kind);
        CHECK(again.events[i].change == outline.events[i].change);
        CHECK(again.events[i].end == outline.events[i].end);
        CHECK(again.events[i].text == outline.events[i].text);
    }
}
