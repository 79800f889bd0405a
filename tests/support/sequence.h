// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/filters/svgf_filter.h"
#include "renderer/pipeline/renderer.h"
#include "renderer/scene/scene.h"

#include <cstring>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace afterglow::test {

/// A renderer with a scene, rendered frame by frame on a fixed clock.
class Sequence {
public:
    Sequence(Scene scene, glm::ivec2 size, Settings settings);

    Settings settings;
    std::vector<LightState> lights; ///< by slot; changed between frames
    Camera camera;                  ///< the scene's first; changed between frames
    double secondsPerFrame = 0.0;   ///< 0: nothing moves
    std::uint32_t seed = 1;

    /// Renders the next frame; returns its number.
    std::uint32_t next();
    void run(int frames);

    LightState& light(std::string_view name);
    void allLightsOffBut(std::string_view name);

    /// Returns the converged demodulated signal of the moment of the last frame. Ends the
    /// sequence's history.
    Image<glm::vec4> reference(int samples);

    Renderer& renderer() { return renderer_; }
    const RenderTargets& targets() const { return renderer_.targets(); }
    Image<glm::vec4> signal() const { return renderer_.filteredSignal().read<glm::vec4>(); }

private:
    FrameInput input() const;

    Renderer renderer_;
    std::uint32_t frame_ = 0;
};

/// Returns settings with a filter and a signal, all else at its default.
Settings settingsOf(Filter filter, Signal signal = Signal::Both);

/// Returns an image of a filter of SVGF's family, which it has made.
inline const GpuTexture& imageOf(const RenderTargets& targets, svgf::Image image,
                                 std::size_t state = 0, std::size_t signal = 0) {
    const GpuTexture* const found = targets.filters.at(state).own.at(signal).find(image);
    if (!found)
        throw std::logic_error("the filter has not made that image");
    return *found;
}

/// Returns the number of pixels whose bits differ, -1 for images of unequal size.
template <class Pixel>
int differingPixels(const Image<Pixel>& a, const Image<Pixel>& b) {
    if (a.size() != b.size())
        return -1;
    int count = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i)
        count += std::memcmp(&a.pixels()[i], &b.pixels()[i], sizeof(Pixel)) != 0;
    return count;
}

} // namespace afterglow::test
