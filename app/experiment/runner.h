// SPDX-License-Identifier: MIT
#pragma once

#include "app/base/output.h"
#include "app/base/progress.h"
#include "app/measure/reference.h"
#include "app/scenario/experiment.h"
#include "app/scenario/run_plan.h"

#include <filesystem>

namespace afterglow {

class ImportedFrames;

/// One of `count` equal shares of the frames of a run.
struct Part {
    int index = 1, count = 1; ///< index in [1, count]
    bool isWhole() const { return count == 1; }
};

/// The frames that a part measures and writes. To get there it renders those before as well, since
/// every frame's history is the frame before. May be empty if there are more parts than frames.
FrameRange framesOf(Part part, int frames);

struct RunOptions {
    Part part = {};
    bool fresh = false; ///< do again what the folder holds, and replace another run in it
    /// The frames of one external variant, which is measured from them; of whole runs only.
    const ImportedFrames* imported = nullptr;
};

/// Whether a whole run into this folder has measured the variant, with this program and the same
/// references.
bool isMeasured(const Variant& variant, const Experiment& experiment, const StagedRun& run,
                const ReferenceMaker& maker, const std::filesystem::path& folder);

/// The work of a run, in units of Progress.
double workOf(const Experiment& experiment, const RunPlan& plan, Part part);

/// Runs every variant over the timeline, from frame 0 and with the same seed, and compares its
/// frames with references from the store. Files: docs/cli.md. The renderer's scene and size are set
/// by this.
///
/// A variant whose files are there already, made by the same program from the same experiment, is
/// not run again: so an interrupted run goes on where it was. What a part leaves is for merge().
/// Another run in the folder is a UsageError unless `options.fresh`: see run_owner.h.
/// An external variant can only be there already, unless `options` has its frames: InputError.
void runExperiment(const Experiment& experiment, const StagedRun& run, Renderer& renderer,
                   const GlInfo& gl, ReferenceStore& store, const OutputFolder& folder,
                   const RunOptions& options, Progress& progress);

} // namespace afterglow
