// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace afterglow {

/// The way in which one number of a run is computed from the values of its frames.
enum class Aggregation {
    None,
    // Of the whole run:
    SettledMean, ///< mean over the settled window
    Mean,        ///< over all frames
    ChangeMean,  ///< over the frames in which light or scene change
    EventMean,   ///< over kNoiseFrames from the first event on
    // Of a step of the light:
    TimeTo,       ///< frames until the curve stays above a level
    AreaAbove,    ///< the area between the curve and 1
    Overshoot,    ///< how far the curve rises above 1
    BeforeMean,   ///< mean over the window before the step
    LateMean,     ///< mean over the last window after it
    OwnTimeTo,    ///< as TimeTo, between the filter's own settled values
    OwnAreaAbove, ///< as AreaAbove, likewise
    StepMean,     ///< mean over kNoiseFrames from the step on
    SettleTime,   ///< frames until the value stays within 10 % of what it settles at
    // Of a motion:
    MotionMean, ///< mean over the frames in which something moves
    // Of either:
    TrailMean, ///< mean from the change on, kTrailFrames longer than it lasts
    Recovery,  ///< frames from the change's end until the value is as low as where it settles
    // Not from metrics.csv:
    Timing, ///< of timing.json
    Import  ///< of the import.json of frames that another program made
};

/// Places that show a number of a run, beside the tables of the report.
enum Place : unsigned {
    kConsole = 1,  ///< the table that a run prints
    kSheet = 2,    ///< the contact sheet
    kOverview = 4, ///< the report's first table of a suite
    kResults = 8   ///< the table of docs/results.md
};

/// A number that describes a filter: in metrics.csv one of a frame, in summary.json one of a run,
/// or both. Everything that names, explains or shows it reads its row.
struct Metric {
    std::string_view key;    ///< in the files
    std::string_view label;  ///< in tables
    std::string_view unit;   ///< empty: none
    std::string_view better; ///< "low", "high", or empty where neither is
    int digits;              ///< after the point
    Aggregation aggregation;
    std::string_view tip; ///< one sentence or two
    /// The metric of frames that it aggregates. Empty: it is a metric of frames itself, and
    /// aggregates its own values.
    std::string_view of = {};
    double level = 0.0;          ///< of TimeTo and OwnTimeTo
    std::string_view group = {}; ///< in the report's table of variants; empty: it is not there
    unsigned shown = 0;          ///< a union of Places
    /// The metric that tells two meanings of null apart: where it has a number this one was never
    /// reached, elsewhere it was not measured.
    std::string_view reachedIf = {};
    /// Sheet and report show it only where that metric was not measured.
    std::string_view insteadOf = {};

    bool isOfFrames() const { return of.empty() && aggregation < Aggregation::Timing; }
    bool isWhole() const { return unit == "frames" && digits == 0; }
};

/// Returns all metrics, in the order of summary.json, which is also that of tables.
std::span<const Metric> metrics();

/// The metric of this name. Of several signals a metric of frames is also there for each:
/// "shadows:lambda_rmse". A std::logic_error if no row has it.
const Metric& metricNamed(std::string_view name);

/// The table for programs that show a run: experiment.json and the report carry it.
nlohmann::ordered_json metricsJson();

/// The value of a metric in the summary and the times of one variant, as tables show it: "-" where
/// it was not measured, "never" where it was not reached.
std::string shownValue(const Metric& metric, const nlohmann::ordered_json& summary,
                       const nlohmann::ordered_json& timing);

} // namespace afterglow
