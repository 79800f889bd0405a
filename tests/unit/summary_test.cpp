// SPDX-License-Identifier: MIT
#include "app/measure/summary.h"

#include <cmath>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace afterglow;
using doctest::Approx;
using Json = nlohmann::ordered_json;

namespace {

constexpr int kFrames = 80, kEvent = 30;

Experiment experimentOf(const std::string& timeline) {
    return parseExperiment(
        R"({"name": "made", "scene": "cornell", "frames": 80, "variants": ["svgf"],
        "settledWindow": 8, "timeline": )" +
            timeline + "}",
        "made.json");
}

const char* const kKeyOff = R"([{"frame": 30, "light": "key", "on": false}])";

/// An average of weight 0.2 between these settled responses.
MetricsTable lagging(double start, double end) {
    MetricsTable table;
    for (int frame = 0; frame < kFrames; ++frame) {
        table.add("svgf", frame, "rmse", frame < kEvent ? 0.1 : 0.2);
        if (frame < kEvent) {
            if (frame >= kEvent - 8)
                table.add("svgf", frame, "response_before", start);
            continue;
        }
        const double arrived = 1.0 - std::pow(0.8, frame - kEvent + 1);
        table.add("svgf", frame, "response", start + arrived * (end - start));
        table.add("svgf", frame, "noise", frame < kEvent + 5 ? 0.5 : 0.1);
    }
    return table;
}

Json summaryOfMade(const std::string& timeline, const MetricsTable& table) {
    const Experiment experiment = experimentOf(timeline);
    return summaryOf(experiment, outlineOf(stagedRun(experiment).plan), table)
        .at("variants")
        .at("svgf");
}

} // namespace

TEST_CASE("the lag of an unbiased filter is the same on both scales, with its closed form") {
    const Json json = summaryOfMade(kKeyOff, lagging(0.0, 1.0));
    for (const char* scale : {"", "lag_"}) {
        CHECK(json.at(std::string(scale) + "t50") == 3);
        CHECK(json.at(std::string(scale) + "t90") == 10);
        CHECK(json.at(std::string(scale) + "t99") == 20);
    }
    CHECK(json.at("ghost_frames").get<double>() == Approx(4.0).epsilon(1e-3));
    CHECK(json.at("lag_frames").get<double>() == Approx(4.0).epsilon(1e-3));
    CHECK(json.at("noise_settle_frames") == 5);
    CHECK(json.at("noise_after_event").get<double>() == Approx((5 * 0.5 + 11 * 0.1) / 16));
    CHECK(json.at("rmse_settled").get<double>() == Approx(0.1));
    CHECK_FALSE(json.contains("events")); // there is but one
}

TEST_CASE("a biased filter never arrives, and its lag is told all the same") {
    const Json json = summaryOfMade(kKeyOff, lagging(0.1, 0.85));
    CHECK(json.at("t50") == 3);
    CHECK(json.at("t90").is_null());
    CHECK(json.at("t99").is_null());
    CHECK(json.at("lag_t90") == 10);
    CHECK(json.at("lag_t99") == 20);
    CHECK(json.at("response_before").get<double>() == Approx(0.1));
    CHECK(json.at("response_settled").get<double>() == Approx(0.85).epsilon(1e-3));
    const std::string text = tableOf({{"variants", {{"svgf", json}}}},
                                     {{"variants", {{"svgf", {{"ms_per_frame", 2.0}}}}}});
    CHECK(text.find("never") != std::string::npos);
}

TEST_CASE("an event that changes nothing that is seen has no response, which is not never") {
    MetricsTable table;
    for (int frame = 0; frame < kFrames; ++frame)
        table.add("svgf", frame, "rmse", 0.1);
    const Json json = summaryOfMade(kKeyOff, table);
    for (const char* key : {"t50", "t90", "ghost_frames", "lag_frames", "noise_after_event",
                            "response_settled", "lambda_false", "flip_settled"}) {
        CAPTURE(key);
        CHECK(json.at(key).is_null());
    }
    CHECK(json.at("recovery_frames") == 0);
    const std::string text = tableOf({{"variants", {{"svgf", json}}}},
                                     {{"variants", {{"svgf", {{"ms_per_frame", 2.0}}}}}});
    CHECK(text.find("never") == std::string::npos);
}

TEST_CASE("of several events the first one stands for the variant, and all are listed") {
    const std::string timeline = R"([{"frame": 30, "light": "key", "on": false},
                                     {"frame": 50, "light": "key", "on": true}])";
    const Json json = summaryOfMade(timeline, lagging(0.0, 1.0));
    REQUIRE(json.at("events").size() == 2);
    CHECK(json.at("events")[0].at("frame") == 30);
    CHECK(json.at("events")[0].at("text") == "key off");
    CHECK(json.at("events")[1].at("text") == "key on");
    CHECK(json.at("t50") == json.at("events")[0].at("t50"));
    CHECK(json.at("t99").is_null()); // 0.8^20 = 0.0115 is left at the next event
    CHECK(json.at("events")[1].at("t50") == 0);
}

TEST_CASE("recovery counts from the end of a motion, to a tenth above what the error settles at") {
    const std::string timeline =
        R"([{"frame": 20, "until": 30, "node": "key", "by": [0.1, 0, 0]}])";
    MetricsTable table;
    for (int frame = 0; frame < kFrames; ++frame)
        table.add("svgf", frame, "rmse", frame < 20 ? 0.1 : frame < 34 ? 0.4 : 0.108);
    for (int frame = 20; frame < kFrames; ++frame)
        table.add("svgf", frame, "ghost_energy", frame < 30 ? 0.5 : 0.1);
    const Json json = summaryOfMade(timeline, table);
    CHECK(json.at("recovery_frames") == 5); // 34, from 29 on, the last frame in which it moves
    CHECK(json.at("rmse_moving").get<double>() == Approx(0.4));
    CHECK(json.at("ghost_energy").get<double>() == Approx((10 * 0.5 + 16 * 0.1) / 26));
    CHECK_FALSE(json.contains("t50"));
}
