// SPDX-License-Identifier: MIT
#pragma once

#include "app/measure/metrics_table.h"
#include "app/measure/run_outline.h"
#include "app/report/contact_sheet.h"

#include <filesystem>

#include <nlohmann/json_fwd.hpp>

namespace afterglow {

/// The contact sheet of a run whose files are in `folder`: a few columns around the first event, or
/// spread over the run if there is none. `summary` and `timing` are those of summary.json and
/// timing.json. A picture that is not there is left blank.
Image<glm::u8vec4> drawRunSheet(const Experiment& experiment, const RunOutline& outline,
                                const MetricsTable& table, const nlohmann::ordered_json& summary,
                                const nlohmann::ordered_json& timing,
                                const std::filesystem::path& folder);

} // namespace afterglow
