// SPDX-License-Identifier: MIT
// The shipped experiments, small: what a change may not make worse. Every bound is what was
// measured plus a tenth; the causes say why it was not less.

#include "tests/app/program.h"

#include <cmath>
#include <optional>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace afterglow::test {

namespace {

using Json = nlohmann::json;

/// All of them at 96x54 with an eighth of the reference samples, run once.
const Json& suite() {
    static const Json all = [] {
        const TemporaryFolder folder;
        const Run run = afterglow({"experiment", "all", "--quick", "--no-cache", "--context",
                                   "osmesa", "--out", folder / "suite"});
        if (run.exitCode != 0)
            throw std::runtime_error("the suite failed: " + run.err);
        Json result;
        for (const auto& entry : std::filesystem::directory_iterator(folder / "suite"))
            if (entry.is_directory())
                result[entry.path().filename()] =
                    Json::parse(bytesOf(entry.path() / "summary.json")).at("variants");
        return result;
    }();
    return all;
}

std::optional<double> measured(const std::string& experiment, const std::string& variant,
                               const std::string& key) {
    const Json& value = suite().at(experiment).at(variant).at(key);
    return value.is_null() ? std::nullopt : std::optional(value.get<double>());
}

struct Gate {
    const char *experiment, *variant, *key;
    double measured;
    const char* cause;
};

// A tenth of fewer than 10 frames is less than one: a frame later fails.
void checkGates(std::initializer_list<Gate> gates) {
    for (const Gate& gate : gates) {
        CAPTURE(gate.experiment);
        CAPTURE(gate.variant);
        CAPTURE(gate.key);
        CAPTURE(gate.cause);
        const auto value = measured(gate.experiment, gate.variant, gate.key);
        REQUIRE(value);
        // Below 0.01 frames or 1e-4 of noise there is nothing to see.
        const double slack = std::string_view(gate.key).ends_with("frames") ? 0.01 : 1e-4;
        CHECK(*value <= 1.1 * gate.measured + slack);
    }
}

constexpr const char* kClosedForm = "0.8^(k+1) is below 0.5, 0.1 and 0.01 from k = 3, 10 and 20";
constexpr const char* kArea = "(1 - 0.2) / 0.2 frames";
constexpr const char* kReset = "lambda is 1 in the frame of the event";
constexpr const char* kPartial = "lambda is the share that changed; the rest is averaged away";
constexpr const char* kFewSamples = "after the event there are few samples a pixel";
constexpr const char* kBlur = "the spatial filter's bias at this size, not noise";
constexpr const char* kNoise = "sqrt(0.2 / 1.8) of one sample's deviation";
constexpr const char* kCount = "a mean of up to 128 samples, from which changes take some";
constexpr const char* kStill = "what the spatial filter leaves of the noise";
constexpr const char* kCarried = "one sample in nine is the last frame's again";

} // namespace

TEST_CASE("lag is no longer than it was, in any experiment") {
    checkGates({
        {"light-off", "fixed", "t50", 3, kClosedForm},
        {"light-off", "fixed", "t90", 10, kClosedForm},
        {"light-off", "fixed", "ghost_frames", 4.01, kArea},
        {"light-off", "asvgf", "t99", 0, kReset},
        {"light-off", "asvgf", "ghost_frames", 0.0, kReset},
        {"light-on", "asvgf", "lag_t90", 0, kReset},
        {"light-on", "asvgf", "lag_frames", 0.0745, kReset},
        {"light-dim", "asvgf", "t50", 0, kPartial},
        {"light-dim", "asvgf", "lag_t90", 0, kPartial},
        {"light-dim", "asvgf", "lag_frames", 0.232, kPartial},
        {"fill-light", "asvgf", "t90", 0, kPartial},
        {"fill-light", "asvgf", "lag_frames", 0.0536, kPartial},
        {"flicker", "asvgf", "t90", 0, kPartial},
        {"flicker", "asvgf", "ghost_frames", 0.0, kPartial},
        {"sparse-light", "asvgf", "lag_t90", 9, "few samples know of the lamp"},
        {"light-color", "asvgf", "lag_t90", 10, "a gradient of luminance is blind to it"},
        {"light-move", "asvgf", "rmse_moving", 0.0337, kBlur},
        {"object-move", "asvgf", "rmse_moving", 0.0236, kBlur},
        {"camera-pan", "asvgf", "rmse_moving", 0.0283, kBlur},
        {"camera-cut", "asvgf", "rmse_moving", 0.0416, kFewSamples},
        {"camera-cut", "asvgf", "recovery_frames", 3, kFewSamples},
        {"light-off", "counted", "lag_frames", 0.00294, kCount},
        {"light-on", "counted", "lag_frames", 0.218, kCount},
        {"light-dim", "counted", "lag_frames", 0.00752, kCount},
        {"fill-light", "counted", "lag_frames", 0.00267, kCount},
        {"light-color", "counted", "lag_frames", 0.0849, kCount},
        {"sparse-light", "counted", "lag_t90", 19,
         "at this size few strata hold a sample of the lamp"},
        {"light-move", "counted", "rmse_moving", 0.0249, kCount},
        {"object-move", "counted", "rmse_moving", 0.0156, kCount},
        {"camera-pan", "counted", "rmse_moving", 0.0148, kCount},
        {"camera-cut", "counted", "rmse_moving", 0.0294, kFewSamples},
        {"gloss-off", "counted", "lag_frames", 0.0341, kCount},
        {"mirror-walk", "counted", "rmse_moving", 0.0942,
         "a reflection in a rounded mirror moves otherwise than its surface"},
    });
}

TEST_CASE("noise is no higher than it was, in any experiment") {
    checkGates({
        {"static", "fixed", "rmse_settled", 0.0339, kNoise},
        {"static", "fixed", "flicker", 0.0209, kNoise},
        {"static", "svgf", "rmse_settled", 0.0312, kBlur},
        {"static", "svgf", "flicker", 0.00293, kStill},
        {"static", "asvgf", "rmse_settled", 0.0313, kBlur},
        {"static", "asvgf", "flicker", 0.00364, kCarried},
        {"static", "asvgf", "temporal_error_settled", 0.00376, kCarried},
        {"static", "asvgf", "flip_settled", 0.127, kBlur},
        {"fill-light", "asvgf", "noise_after_event", 0.0141, kFewSamples},
        {"light-on", "asvgf", "noise_after_event", 0.0269, kFewSamples},
        {"light-dim", "asvgf", "noise_after_event", 0.0136, kFewSamples},
        {"camera-cut", "asvgf", "flicker", 0.00444, kCarried},
        {"static", "counted", "rmse_settled", 0.00628, kCount},
        {"static", "counted", "flicker", 0.000824, kCount},
        {"static", "counted", "flip_settled", 0.0248, kCount},
        {"fill-light", "counted", "noise_after_event", 0.00928, kFewSamples},
        {"light-dim", "counted", "noise_after_event", 0.00456, kFewSamples},
        {"bounce-off", "counted", "rmse_settled", 0.0192, kCount},
        {"gloss-off", "counted", "rmse_settled", 0.0208, kCount},
        {"gloss-off", "counted", "flicker", 0.00198, kCount},
    });
}

TEST_CASE("there is no false alarm where nothing that is seen changes") {
    // Exact: equal random numbers on equal surfaces in equal light have equal values.
    for (const char* still : {"static", "unrelated-light"})
        for (const char* filter : {"asvgf", "counted"})
            CHECK(measured(still, filter, "lambda_false") == 0.0);
    // Luminances of two colors that should be equal differ by rounding.
    CHECK(measured("light-color", "asvgf", "lambda_false").value() <= 1e-6);
    // A moving camera rounds differently: |delta| <= 1e-4 Delta.
    for (const char* moving : {"camera-pan", "camera-cut"})
        CHECK(measured(moving, "asvgf", "lambda_false").value() <= 1e-4);
    for (const char* lit : {"fill-light", "object-move", "light-move"})
        CHECK(measured(lit, "asvgf", "lambda_false").value() <= 1e-3);
}

TEST_CASE("lambda finds what changed where it is told by luminance") {
    for (const char* name : {"light-off", "light-on", "light-dim"}) {
        CAPTURE(name);
        CHECK(measured(name, "asvgf", "lambda_recall") == 1.0);
        CHECK(measured(name, "asvgf", "lambda_precision") == 1.0);
        CHECK(std::abs(measured(name, "asvgf", "lambda_bias").value()) < 0.01);
    }
    CHECK(measured("fill-light", "asvgf", "lambda_recall").value() > 0.9);
    CHECK(measured("fill-light", "asvgf", "lambda_precision").value() > 0.9);
}

TEST_CASE("A-SVGF lags less than SVGF wherever luminance changes at once, at equal settled noise") {
    for (const char* name : {"light-off", "light-on", "light-dim", "fill-light", "flicker"}) {
        CAPTURE(name);
        CHECK(measured(name, "asvgf", "lag_frames").value() <
              0.55 * measured(name, "svgf", "lag_frames").value());
        CHECK(measured(name, "asvgf", "rmse_settled").value() <
              1.02 * measured(name, "svgf", "rmse_settled").value());
    }
}

TEST_CASE("counted has less error than A-SVGF while nothing happens, and sees a change of color") {
    for (const char* name : {"static", "light-off", "light-dim", "fill-light", "camera-pan",
                             "bounce-off", "gloss-off"}) {
        CAPTURE(name);
        CHECK(measured(name, "counted", "rmse_settled").value() <
              0.7 * measured(name, "asvgf", "rmse_settled").value());
        CHECK(measured(name, "counted", "flicker").value() <
              0.7 * measured(name, "asvgf", "flicker").value());
    }
    CHECK(measured("light-color", "counted", "lag_t90") == 0.0);
    CHECK(measured("light-color", "asvgf", "lag_t90").value() > 8.0);
}

TEST_CASE("the healthy suite has no value that is not a number") {
    for (const auto& [experiment, variants] : suite().items())
        for (const auto& [name, variant] : variants.items()) {
            CAPTURE(experiment);
            CAPTURE(name);
            CHECK(variant.at("invalid_values") == 0.0);
        }
}

} // namespace afterglow::test
