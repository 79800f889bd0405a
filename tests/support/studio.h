// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/pipeline/renderer.h"
#include "renderer/scene/scene.h"

#include <vector>

namespace afterglow::test {

/// A renderer, and references of moments of its scene.
struct Studio {
    Studio(Scene scene, glm::ivec2 size, Signal signal = Signal::Both);

    /// Returns the input of a frame seen by `camera`, with seed 5. The lights must outlive it.
    FrameInput at(double seconds, const std::vector<LightState>& lights) const;
    FrameInput at(double seconds) const { return at(seconds, allOn); }

    /// Returns the converged signal; see Renderer::beginReference().
    Image<glm::vec4> reference(const FrameInput& seen, const FrameInput& world, int samples);
    Image<glm::vec4> reference(const FrameInput& moment, int samples) {
        return reference(moment, moment, samples);
    }

    const RenderTargets& targets() const { return renderer.targets(); }
    Image<glm::uvec4> visibility() const {
        return targets().surfaces.visibility.read<glm::uvec4>();
    }

    Settings settings;
    std::vector<LightState> allOn;
    Camera camera; ///< the scene's first
    Renderer renderer;
};

} // namespace afterglow::test
