// SPDX-License-Identifier: MIT
#pragma once

#include "app/scenario/experiment.h"

namespace afterglow {

/// A range of frames [first, end).
struct FrameRange {
    int first = 0, end = 0;
    bool contains(int frame) const { return frame >= first && frame < end; }
    int frames() const { return end - first; }
    bool operator==(const FrameRange&) const = default;
};

/// A change that the summary speaks of.
struct RunEvent {
    enum class Kind {
        Step,  ///< light alone: it has a response
        Motion ///< the camera or the scene moves: while it does, and what is left afterwards
    };
    Kind kind = Kind::Step;
    FrameRange change;  ///< a step's one frame, or the frames in which something moves
    int end = 0;        ///< the frames up to the next event
    std::string text{}; ///< "key off"
};

/// The number of frames in which the trail of what moves is looked for.
inline constexpr int kTrailFrames = 16;

/// The plan of a run, which is known before a frame is rendered.
struct RunPlan {
    std::vector<Interval> intervals;
    std::vector<RunEvent> events; ///< changes of what is seen or how it is lit, in order
    /// The last Experiment::settledWindow frames of the first interval, of two frames or more, in
    /// which there is light; of the last interval if there is none.
    FrameRange settled;
    std::vector<int> pictures; ///< the frames that reports show, rising
};

/// A run that can begin: its scene, with the motions of its timeline, and its plan.
struct StagedRun {
    Scene scene;
    RunPlan plan;
};

/// Loads the scene and plans the run. InputError names what the scene does not have; see
/// loadScene() for the scene itself.
StagedRun stagedRun(const Experiment& experiment);

} // namespace afterglow
