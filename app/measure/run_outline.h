// SPDX-License-Identifier: MIT
#pragma once

#include "app/base/json_reader.h"
#include "app/scenario/run_plan.h"

#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace afterglow {

/// The part of a run's plan that summary, sheet and report read. experiment.json holds it, so that
/// nobody who reads a run needs its scene.
struct RunOutline {
    std::vector<RunEvent> events = {}; ///< in order
    FrameRange settled = {};
    std::vector<int> pictures = {};          ///< the frames that reports show, rising
    std::vector<int> changes = {};           ///< the frames in which light or scene change, rising
    std::vector<FrameRange> references = {}; ///< the frames that share a reference, in order
};

RunOutline outlineOf(const RunPlan& plan);

/// Adds the outline to an experiment.json, but for its references.
void writeOutline(const RunOutline& outline, nlohmann::ordered_json& json);

/// Reads what an experiment.json says; references are those that it lists. `frames`: of the
/// experiment.
RunOutline readOutline(const JsonReader& json, int frames);

} // namespace afterglow
