// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "tests/reference/paths.h"
#include "tests/stage/scene_frames.h"

// Compares the signals of paths with the reference, which starts from the surfaces and the seeds
// that the frame holds: as tests/stage/scene_judges.h.

namespace afterglow::test {

/// The surfaces that paths begin on, and what the passes made of them.
struct PathImages {
    Image<glm::uvec4> visibility, surface;
    Image<glm::vec4> guides;
    Image<std::uint32_t> seeds;
    std::vector<Image<glm::vec4>> raw;      ///< by signal
    std::vector<Image<glm::vec4>> divisors; ///< by signal; empty: not compared
};
PathImages pictureOf(const RenderTargets& targets);
/// Of the gradient samples that are shaded beside the picture.
PathImages samplesBesideOf(const RenderTargets& targets);

/// The scene, pose and lights in which paths are traced.
struct PathMoment {
    const Scene& source;
    const reference::SceneView& rest; ///< at time 0
    const reference::SceneView& scene;
    std::vector<glm::dvec3> lightScales; ///< by slot
    glm::dvec3 eye{0.0}, previousEye{0.0};
    std::uint32_t frame = 0, runSeed = 0;
    LightingSettings lighting;
    double regularization = 0.0;
};
PathMoment momentOf(const SceneFrames& frames, const SceneFrame& frame);

struct PathVerdict {
    int surfaces = 0, direct = 0, shadowed = 0, indirect = 0, specular = 0, left = 0, escaped = 0,
        hitLight = 0;
    int carried = 0;    ///< whose seed is that of the frame before
    int withOldEye = 0; ///< of those, whose light would clearly be another from this frame's eye
    int excused = 0, wrong = 0;
    int spread = 0;         ///< of those that are right, which need more than the plain tolerance
    double largest = 0.0;   ///< relative to max(0.01, value), of those that do not
    double luminance = 0.0; ///< likewise
    double divisor = 0.0;   ///< largest difference

    void operator+=(const PathVerdict& other);
};
PathVerdict judgePaths(const PathMoment& moment, const PathImages& images);

} // namespace afterglow::test
