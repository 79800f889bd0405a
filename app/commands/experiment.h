// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/headless.h"
#include "app/experiment/runner.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace afterglow {

/// Where references are kept between runs.
struct CacheOptions {
    bool use = true;
    std::optional<std::filesystem::path> folder = {}; ///< instead of the user's
};
ReferenceStore makeStore(const CacheOptions& options, const Headless& headless);

/// What `afterglow experiment` and `afterglow sweep` were asked for.
struct ExperimentOptions {
    std::vector<std::string> experiments; ///< names of built-in ones, or files; "all": all built in
    // Instead of what the experiments say themselves:
    std::optional<glm::ivec2> size;
    std::optional<int> frames;        ///< events at later frames do not happen
    std::optional<Signal> signal;     ///< instead of the experiment's own
    std::optional<int> samples;       ///< of each reference, per pixel
    std::vector<std::string> filters; ///< as variants
    std::vector<std::pair<std::string, std::string>> settings; ///< of every variant, for setField()
    bool quick = false; ///< small pictures and rough references, where nothing else is said

    RunOptions run;
    CacheOptions cache;
    ContextWish context;
    std::string out;
};

/// Values of one setting, with each of which every variant is run.
struct Sweep {
    std::string key;
    std::vector<std::string> values;
};

/// Runs them, into the folder itself if there is only one and else into a folder each, and prints
/// tables.
void runExperimentCommand(const ExperimentOptions& options, HiddenContextFactory hiddenContext);

/// The same for each value of a setting; one experiment, into the folder itself.
void runSweepCommand(const ExperimentOptions& options, const Sweep& sweep,
                     HiddenContextFactory hiddenContext);

/// Puts the parts of a run together and prints its tables.
void runMergeCommand(const std::vector<std::filesystem::path>& parts, const std::string& out,
                     bool fresh);

/// Makes report.html of a run, or of a folder of runs, anew.
void runReportCommand(const std::string& folder);

} // namespace afterglow
