// SPDX-License-Identifier: MIT
#pragma once

#include "app/base/output.h"
#include "app/base/progress.h"
#include "app/scenario/run_plan.h"
#include "renderer/pipeline/aov.h"

#include <filesystem>
#include <string>
#include <vector>

namespace afterglow {

/// Renders the frames of an experiment as its filters get them, and writes for each what a denoiser
/// needs: raw, albedo, emission, normal, depth, motion and previous_depth, then `more` AOVs, which
/// the filter `none` makes; `format` is "exr" or "pfm". Last of all export.json, which says what
/// they mean: docs/denoisers.md. The renderer's scene and size are set by this.
void exportFrames(const Experiment& experiment, const StagedRun& run, Renderer& renderer,
                  const GlInfo& gl, const std::vector<const AovInfo*>& more,
                  const std::string& format, const OutputFolder& folder, Progress& progress);

/// The experiment of an export's frames. InputError names the file that is missing or damaged.
Experiment readExport(const std::filesystem::path& folder);

} // namespace afterglow
