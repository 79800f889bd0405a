// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/arguments.h"
#include "app/commands/experiment.h"
#include "app/commands/headless.h"
#include "app/experiment/import_frames.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace afterglow {

/// What `afterglow render --export` was asked for.
struct ExportOptions {
    std::string source; ///< a scene, or else an experiment: a built-in one, or a .json file
    // Of either:
    std::optional<glm::ivec2> size;
    std::optional<int> frames;
    std::optional<std::uint32_t> seed;
    // Of a scene only; an experiment says these itself:
    std::string camera; ///< empty, or the scene's first
    std::vector<LightEvent> lights;
    std::optional<Signal> signal;
    std::optional<double> rate;
    bool animate = false;

    std::vector<std::string> aovs; ///< beside those that every export has
    std::string format = "exr";    ///< or "pfm"
    ContextWish context;
    std::string out;
};

/// Writes what a denoiser needs of every frame, and export.json.
void runExportCommand(const ExportOptions& options, HiddenContextFactory hiddenContext);

/// What `afterglow import-frames` was asked for.
struct ImportOptions {
    std::filesystem::path exported, frames; ///< folders
    std::string name;                       ///< of the variant
    std::optional<Quantity> quantity;
    std::vector<std::string> filters; ///< as variants, instead of the experiment's own
    bool only = false;                ///< without variants of ours
    bool fresh = false;               ///< replace what the folder holds
    std::optional<int> samples;       ///< of each reference, per pixel
    CacheOptions cache;
    ContextWish context;
    std::string out;
};

/// Measures the frames of another denoiser beside our filters, as a run in its folder. Those that
/// were imported there before, of the same experiment, stay in it.
void runImportCommand(const ImportOptions& options, HiddenContextFactory hiddenContext);

} // namespace afterglow
