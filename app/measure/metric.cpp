// SPDX-License-Identifier: MIT
#include "app/measure/metric.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace afterglow {
namespace {

using Json = nlohmann::ordered_json;
using enum Aggregation;

constexpr const char *kResponse = "Response", *kError = "Error", *kCost = "Cost";
constexpr const char* kGhost = "ghost_frames";

// clang-format off
constexpr Metric kMetrics[] = {
    {"response", "response", "", "", 3, None, "0 is the old light, 1 the new."},
    {"t50", "t50", "frames", "low", 0, TimeTo,
     "Frames from the event, whose own is 0, until half of the change has arrived, to stay.",
     "response", 0.5, kResponse, kConsole | kSheet | kResults, kGhost},
    {"t90", "t90", "frames", "low", 0, TimeTo,
     "Frames from the event until 90 % of the change has arrived, to stay.",
     "response", 0.9, kResponse, kConsole | kSheet | kOverview | kResults, kGhost},
    {"t99", "t99", "frames", "low", 0, TimeTo,
     "Frames from the event until 99 % of the change has arrived, to stay. \"never\" may be bias and not lag: see lag t90.",
     "response", 0.99, kResponse, kConsole | kSheet | kResults, kGhost},
    {kGhost, "ghost frames", "frames", "low", 2, AreaAbove,
     "The area above the response curve: how many frames’ worth of old light is left.",
     "response", 0.0, kResponse, kConsole | kSheet | kOverview | kResults},
    {"overshoot", "overshoot", "", "low", 3, Overshoot, "How far the response rises above 1.",
     "response", 0.0, "", kConsole},
    {"response_before", "response before", "", "", 3, BeforeMean, "Where the filter stands before the change."},
    {"response_settled", "response settled", "", "", 3, LateMean, "Where the filter settles after the change.", "response"},
    {"lag_t50", "lag t50", "frames", "low", 0, OwnTimeTo,
     "As t50, but measured against where this filter itself settles: lag without bias.",
     "response", 0.5, "", 0, "lag_frames"},
    {"lag_t90", "lag t90", "frames", "low", 0, OwnTimeTo,
     "As t90, but measured against where this filter itself settles: lag without bias.",
     "response", 0.9, kResponse, kConsole | kResults, "lag_frames"},
    {"lag_t99", "lag t99", "frames", "low", 0, OwnTimeTo,
     "As t99, but measured against where this filter itself settles: lag without bias.",
     "response", 0.99, "", 0, "lag_frames"},
    {"lag_frames", "lag frames", "frames", "low", 2, OwnAreaAbove,
     "The area above the curve between where this filter settles before and after: lag without bias.",
     "response", 0.0, kResponse, kResults},
    {"noise", "noise", "", "low", 4, None, "RMSE without the part that is lag."},
    {"noise_after_event", "noise after", "", "low", 4, StepMean,
     "RMSE in the frames after the event, without the part that is lag.",
     "noise", 0.0, kError, kConsole | kResults},
    {"noise_settle_frames", "noise settles", "frames", "low", 0, SettleTime,
     "Frames until the noise stays within a tenth of what it settles at.", "noise"},
    {"rmse_moving", "RMSE moving", "", "low", 4, MotionMean,
     "Root of the mean squared error of linear color, while something moves.",
     "rmse", 0.0, kError, kOverview | kResults},
    {"flip_moving", "FLIP moving", "", "low", 4, MotionMean, "FLIP while something moves.", "flip"},
    {"temporal_error_moving", "temporal error moving", "", "low", 4, MotionMean,
     "The error of the change from frame to frame, while something moves.", "temporal_error"},
    {"ghost_energy", "ghost energy", "", "low", 3, TrailMean,
     "Old light that is left along the trail, as a part of all that changed.",
     "", 0.0, kResponse, kConsole | kSheet, "", kGhost},
    {"trail_response", "trail response", "", "high", 3, TrailMean,
     "How much of what changed in the last 16 frames has arrived; 1 is all. Noise hardly moves it.",
     "", 0.0, kResponse, 0, "", kGhost},
    {"recovery_frames", "recovery", "frames", "low", 0, Recovery,
     "Frames from the end of the change until the error is no more than a tenth above what it settles at.",
     "rmse", 0.0, kResponse, kConsole | kResults},
    {"rmse", "RMSE", "", "low", 4, None, "Root of the mean squared error of linear color."},
    {"rmse_settled", "RMSE", "", "low", 4, SettledMean,
     "Root of the mean squared error of linear color, in settled frames.",
     "rmse", 0.0, kError, kConsole | kSheet | kResults},
    {"relmse", "relMSE", "", "low", 4, None, "Squared error over squared reference."},
    {"relmse_settled", "relMSE", "", "low", 4, SettledMean, "Squared error over squared reference, in settled frames.", "relmse"},
    {"psnr", "PSNR", "dB", "high", 2, None, "Ratio of the signal’s peak to the noise of the display image."},
    {"psnr_settled", "PSNR", "dB", "high", 2, SettledMean,
     "Ratio of the signal’s peak to the noise of the display image, in settled frames.", "psnr"},
    {"ssim", "SSIM", "", "high", 4, None, "Structural similarity to the reference; 1 is the same."},
    {"ssim_settled", "SSIM", "", "high", 4, SettledMean,
     "Structural similarity to the reference; 1 is the same. Settled frames.", "ssim", 0.0, kError},
    {"flip", "FLIP", "", "low", 4, None, "The difference from the reference that an eye sees when it flips between the two."},
    {"flip_settled", "FLIP", "", "low", 4, SettledMean,
     "The difference from the reference that an eye sees when it flips between the two; 0 is none. Settled frames.",
     "flip", 0.0, kError, kConsole | kOverview | kResults},
    {"temporal_error", "temporal error", "", "low", 4, None, "The error of the change from frame to frame."},
    {"temporal_error_settled", "temporal error", "", "low", 4, SettledMean,
     "The error of the change from frame to frame, in settled frames.", "temporal_error"},
    {"flicker", "flicker", "", "low", 4, SettledMean,
     "Standard deviation over time of a pixel while nothing changes, averaged over pixels.",
     "", 0.0, kError, kConsole | kResults},
    {"mean", "mean", "", "", 3, Import, "The settled mean of imported frames divided by that of the reference.",
     "", 0.0, "", kConsole},
    {"flip_mean", "FLIP mean", "", "low", 4, Mean, "FLIP, mean over all frames.", "flip"},
    {"lambda_bias", "λ bias", "", "", 4, ChangeMean, "λ found minus λ ideal, mean."},
    {"lambda_rmse", "λ RMSE", "", "low", 4, ChangeMean, "λ found against λ ideal."},
    {"lambda_precision", "λ precision", "", "high", 3, ChangeMean, "Of what is called changed, how much did."},
    {"lambda_recall", "λ recall", "", "high", 3, ChangeMean, "Of what changed, how much is called so."},
    {"lambda_mean", "λ mean", "", "", 4, ChangeMean, "The share of the history that is dropped."},
    {"lambda_ideal_mean", "λ ideal mean", "", "", 4, ChangeMean, "The share of the light that changed."},
    {"lambda_false", "λ false", "", "low", 4, Mean,
     "False alarms: the part of the history that was dropped where nothing had changed, mean over all frames.",
     "", 0.0, kError, kConsole},
    {"alpha_bias", "α bias", "", "", 4, None, "α used minus α ideal, mean."},
    {"alpha_rmse", "α RMSE", "", "low", 4, None, "α used against α ideal."},
    {"alpha_bias_settled", "α bias", "", "", 4, SettledMean, "α used minus α ideal, in settled frames.", "alpha_bias"},
    {"alpha_rmse_settled", "α RMSE", "", "low", 4, SettledMean, "α used against α ideal, in settled frames.", "alpha_rmse"},
    {"alpha_bias_after_event", "α bias after", "", "", 4, EventMean, "α used minus α ideal, after the event.", "alpha_bias"},
    {"alpha_rmse_after_event", "α RMSE after", "", "low", 4, EventMean, "α used against α ideal, after the event.", "alpha_rmse"},
    {"alpha_mean", "α mean", "", "", 4, None, "The weight of the new sample."},
    {"alpha_ideal_mean", "α ideal mean", "", "", 4, None, "The weight that would leave the least error."},
    {"gradient_samples", "gradient samples", "", "", 0, None, "Points of the last frame that are shaded again."},
    {"rays", "rays", "", "", 0, None, "Rays that are traced in a frame."},
    {"rays_per_frame", "rays a frame", "", "", 0, Mean, "Rays that are traced in a frame, mean over all frames.", "rays"},
    {"invalid_values", "invalid values", "", "low", 0, Mean, "Values that are not numbers; 0 is right."},
    {"ms_per_frame", "ms", "ms", "low", 1, Timing,
     "Milliseconds a frame, median. Of this machine; counts only beside the others.",
     "", 0.0, kCost, kConsole | kSheet | kResults},
};
// clang-format on

constexpr std::pair<Place, const char*> kPlaces[] = {
    {kConsole, "console"}, {kSheet, "sheet"}, {kOverview, "overview"}, {kResults, "results"}};

Json textOrNull(std::string_view text) {
    return text.empty() ? Json(nullptr) : Json(text);
}

} // namespace

std::span<const Metric> metrics() {
    return kMetrics;
}

const Metric& metricNamed(std::string_view name) {
    const std::string_view key = name.substr(name.find(':') + 1); // npos + 1 is 0
    const auto* const found = std::ranges::find(kMetrics, key, &Metric::key);
    if (found == std::end(kMetrics))
        throw std::logic_error(fmt::format("no metric is named {}", name));
    return *found;
}

Json metricsJson() {
    Json rows = Json::array();
    for (const Metric& metric : kMetrics) {
        Json places = Json::array();
        for (const auto& [place, name] : kPlaces)
            if (metric.shown & place)
                places.push_back(name);
        rows.push_back({{"key", metric.key},
                        {"label", metric.label},
                        {"tip", metric.tip},
                        {"unit", textOrNull(metric.unit)},
                        {"better", textOrNull(metric.better)},
                        {"digits", metric.digits},
                        {"frames", metric.isOfFrames()},
                        {"timing", metric.aggregation == Timing},
                        {"group", textOrNull(metric.group)},
                        {"shown", places},
                        {"reached_if", textOrNull(metric.reachedIf)},
                        {"instead_of", textOrNull(metric.insteadOf)}});
    }
    return rows;
}

std::string shownValue(const Metric& metric, const Json& summary, const Json& timing) {
    const Json value = (metric.aggregation == Timing ? timing : summary).value(metric.key, Json());
    if (value.is_number())
        return fmt::format("{:.{}f}", value.get<double>(), metric.digits);
    const bool isReachable = summary.value(metric.reachedIf, Json()).is_number();
    return isReachable ? "never" : "-";
}

} // namespace afterglow
