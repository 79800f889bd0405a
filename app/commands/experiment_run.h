// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/command.h"
#include "app/commands/shared_options.h"
#include "app/experiment/runner.h"

namespace afterglow {

/// The options that `afterglow experiment` and `afterglow sweep` share.
struct ExperimentOptions {
    std::vector<std::string> experiments; ///< names of built-in ones, or files; "all": all built in
    std::string out;
    // Instead of what the experiments say themselves:
    std::vector<Variant> variants;
    std::vector<Assignment> settings; ///< of every variant
    std::optional<glm::ivec2> size;
    std::optional<int> frames; ///< events at later frames do not happen
    std::optional<Signal> signal;
    std::optional<int> samples; ///< of each reference, per pixel
    bool quick = false;         ///< small pictures and rough references, where nothing else is said
    RunOptions run;
    CacheGroup cache;
    ContextGroup context;

    void addTo(Options& options, const std::string& helpOfExperiments);
    /// Returns the experiments with what is asked for instead.
    std::vector<Experiment> chosen() const;
};

/// Runs them, into the folder itself if there is only one and else into a folder each, and prints
/// tables.
void runExperiments(const std::vector<Experiment>& experiments, const ExperimentOptions& options,
                    HiddenContextFactory hiddenContext);

} // namespace afterglow
