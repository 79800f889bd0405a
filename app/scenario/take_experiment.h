// SPDX-License-Identifier: MIT
#pragma once

#include "app/scenario/run_plan.h"
#include "app/scenario/scene_frame.h"

#include <string>

namespace afterglow {

/// Returns the frames of an experiment. Marks are its events after frame 0; cameras moved
/// frame by frame are one motion, marked where it begins. What moves nodes is not in the take: it
/// is in the run's scene.
Take takeOf(const Experiment& experiment, const StagedRun& run);

/// Returns an experiment in which lights and camera change as in the take. `base` has all that a
/// take does not know: name, scene, size, seed, signal, variants; its timeline, rate and `animated`
/// count for nothing. `scene` is what base.scene names, as loadScene() gives it, with no
/// experiment's motions in it; cameras are compared with its first one.
///
/// An experiment starts without histories and at time 0. Before the take's own frames there are
/// `leadIn` more of its first moment. If the scene moves, they are instead as many as lead from
/// time 0 to the take: returned frame n + leadIn is the take's frame n.
///
/// Error names what an experiment cannot hold: a rolled camera, another lens, time
/// that goes on unevenly in a scene that moves, a step in the first frame, more frames than an
/// experiment may have.
Experiment experimentOf(const Take& take, const Scene& scene, Experiment base, int leadIn = 0);

/// Returns the same as the text of a file. Error also where the file's reader would refuse it.
std::string experimentText(const Take& take, const Scene& scene, Experiment base, int leadIn = 0);

} // namespace afterglow
