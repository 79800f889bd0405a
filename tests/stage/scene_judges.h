// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "tests/reference/forward_project.h"
#include "tests/stage/scene_frames.h"

// One function for each stage that knows the scene: compares what a frame holds with the reference,
// which starts from what the frame holds as that stage's inputs. `wrong` counts what nothing
// excuses; `excused` what differs where 32 bits may decide otherwise. Differences that are not a
// matter of yes or no are measured, the largest is kept.

namespace afterglow::test {

struct VisibilityVerdict {
    int pixels = 0, background = 0, excused = 0, wrong = 0;
    double largestShift = 0.0;  ///< pixels between a sample that is not clamped and the center
    double largestWeight = 0.0; ///< difference of barycentrics, where not seen edge-on
};
/// `frame` must be one without merged samples.
VisibilityVerdict judgeVisibility(const SceneFrame& frame);

struct SurfaceVerdict {
    double position = 0.0; ///< extents of the scene
    double geometric = 0.0, shading = 0.0;
    double depth = 0.0;       ///< relative
    double slope = 0.0;       ///< relative to the depth, times the squared cosine of the view
    double motion = 0.0;      ///< pixels
    double motionDepth = 0.0; ///< relative
    double material = 0.0;    ///< albedo and emission, relative to max(1, value)
    int surfaces = 0, moved = 0, turnedOver = 0, behind = 0, excused = 0, wrong = 0;
};
SurfaceVerdict judgeSurface(const SceneFrames& frames, const SceneFrame& frame);

/// By stratum. `plain` is the same frame without merged samples; `merged` must have a history.
struct ForwardVerdict {
    int fates[reference::kFates] = {};
    int strata = 0, filled = 0, contested = 0, doubts = 0, excused = 0, wrong = 0;
    int lost = 0; ///< samples whose stratum another one has

    int of(reference::Fate fate) const { return fates[int(fate)]; }
    void operator+=(const ForwardVerdict& other);
};
ForwardVerdict judgeForward(const SceneFrame& merged, const SceneFrame& plain);

struct LightingVerdict {
    int surfaces = 0, lit = 0, shadowed = 0, occluded = 0, open = 0, excused = 0, wrong = 0;
    double largest = 0.0;   ///< relative to max(0.01, value), where not excused
    double luminance = 0.0; ///< likewise
    std::vector<int> picks; ///< by emitter
};
LightingVerdict judgeLighting(const SceneFrames& frames, const SceneFrame& frame);

struct PictureVerdict {
    double composed = 0.0; ///< relative to max(1, value)
    double display = 0.0;  ///< levels of 255; 0.5 is the rounding
    int background = 0, clipped = 0, dark = 0, wrong = 0;
};
PictureVerdict judgePicture(const SceneFrames& frames, const SceneFrame& frame);

} // namespace afterglow::test
