// SPDX-License-Identifier: MIT
#pragma once

#include "app/experiment/runner.h"

#include <filesystem>
#include <optional>

#include <nlohmann/json.hpp>

namespace afterglow {

// A folder belongs to one run: to one experiment as it was resolved, and to one part of its frames.
// Another run into it is refused, or replaces the first.

/// Returns the experiment as experiment.json holds it: the path of a scene's file is absolute.
nlohmann::ordered_json describe(const Experiment& experiment);

/// A run that asks for a folder.
struct WantedRun {
    nlohmann::ordered_json experiment; ///< as describe() gives it
    Part part = {};
    bool anyVariants = false; ///< a run of other variants is the same run
};

/// Returns the experiment of the run in a folder, finished or not; empty if there is none.
std::optional<nlohmann::ordered_json> experimentIn(const std::filesystem::path& folder);

/// Throws UsageError if the folder holds another run, or holds runs in folders of their own. Writes
/// nothing, and the folder need not be there.
void requireFolderFor(const WantedRun& wanted, const std::filesystem::path& folder);

/// Throws UsageError if a folder that is to hold folders of runs holds a run itself.
void requireFolderForRuns(const std::filesystem::path& folder);

/// Makes the folder that of the run. What requireFolderFor() refuses is removed if `fresh`, and so
/// are variants of the same run that are no longer wanted. Only files of runs are removed.
void takeFolder(const WantedRun& wanted, const OutputFolder& folder, bool fresh);
void takeFolderForRuns(const OutputFolder& folder, bool fresh);

/// Writes experiment.json of a run that is finished.
void writeAccount(const OutputFolder& folder, const nlohmann::ordered_json& account);

} // namespace afterglow
