// SPDX-License-Identifier: MIT
#pragma once

#include "app/base/output.h"

#include <string>

namespace afterglow {

// The files of a run, as docs/cli.md lists them, once the frames are there. A variant's folder is
// finished when it has its timing.json, which is written last and holds the key of what it was made
// from.

/// The key of a finished variant's folder; empty if it is not finished.
std::string finishedKey(const std::filesystem::path& folder);
void forgetFinished(const std::filesystem::path& folder);
/// `parts`: the times of each range of frames, in order.
void markFinished(const OutputFolder& folder, const std::string& key,
                  const nlohmann::ordered_json& parts);

/// From experiment.json and the folders of its variants: metrics.csv, timing.json,
/// contact_sheet.png, report.html and, last, summary.json. InputError names a file that is missing
/// or damaged.
void finishRun(const OutputFolder& folder);

/// Puts the parts of a run, or of a folder of runs, together: the files that one run would have
/// written, byte for byte but for times. InputError if a part is missing, or if they are not parts
/// of one run. Another run in the folder is a UsageError unless `fresh`, which replaces it.
void mergeRuns(const std::vector<std::filesystem::path>& parts, const OutputFolder& out,
               bool fresh);

/// A JSON file of a run; InputError names it if it is missing or damaged.
nlohmann::ordered_json readJson(const std::filesystem::path& file);

} // namespace afterglow
