// SPDX-License-Identifier: MIT
#pragma once

#include "app/measure/metrics_table.h"
#include "app/measure/run_outline.h"
#include "renderer/image/image.h"

#include <filesystem>

#include <nlohmann/json_fwd.hpp>

namespace afterglow {

/// Writes `folder`/report.html: one page that needs no other file and no network, with the curves,
/// the pictures and the tables of an experiment, or of all experiments whose folders lie in
/// `folder` (a suite), in the order of their names. The page appears whole or not at all, and the
/// same files give the same bytes.
///
/// The files of a run are described in docs/cli.md. InputError names the one that is missing or
/// malformed; Error, if the page cannot be written.
void writeReport(const std::filesystem::path& folder);

/// The contact sheet of a run whose files are in `folder`: a few columns around the first event, or
/// spread over the run if there is none. `summary` and `timing` are those of summary.json and
/// timing.json. A picture that is not there is left blank.
Image<glm::u8vec4> drawRunSheet(const Experiment& experiment, const RunOutline& outline,
                                const MetricsTable& table, const nlohmann::ordered_json& summary,
                                const nlohmann::ordered_json& timing,
                                const std::filesystem::path& folder);

} // namespace afterglow
