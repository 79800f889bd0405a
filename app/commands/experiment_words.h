// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/command_words.h"
#include "app/commands/experiment.h"

namespace afterglow {

// The words of the commands that measure: experiment, sweep, merge and report.

/// From --cache and --no-cache, which exclude each other.
CacheOptions parseCache(const Text& folder, bool none);

struct ExperimentWords {
    Texts experiments, settings;
    Text size, frames, signal, samples, filters, part, cache, out;
    ContextWords context;
    bool quick = false, fresh = false, noCache = false;

    void addTo(CLI::App& app);
    ExperimentOptions parse() const;
};

struct SweepWords {
    ExperimentWords experiment;
    Text sweep;

    void addTo(CLI::App& app);
    Sweep parseSweep() const;
};

struct MergeWords {
    Texts parts;
    Text out;
    bool fresh = false;

    void addTo(CLI::App& app);
};

struct ReportWords {
    Text folder;

    void addTo(CLI::App& app);
};

} // namespace afterglow
