// SPDX-License-Identifier: MIT
#pragma once

#include "app/measure/metrics_table.h"
#include "app/measure/run_outline.h"

#include <nlohmann/json_fwd.hpp>

namespace afterglow {

/// summary.json, from nothing but the measures of the frames: one object per variant. Numbers that
/// were never reached, or cannot be had, are null. Where the picture changes more than once, the
/// numbers of a variant are those of the first event, and "events" lists all.
nlohmann::ordered_json summaryOf(const Experiment& experiment, const RunOutline& outline,
                                 const MetricsTable& table);

/// The same as lines to be read; `timing` is that of timing.json.
std::string tableOf(const nlohmann::ordered_json& summary, const nlohmann::ordered_json& timing);

/// Over how many frames after an event its noise is averaged.
inline constexpr int kNoiseFrames = 16;

} // namespace afterglow
