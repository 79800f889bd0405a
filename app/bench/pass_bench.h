// SPDX-License-Identifier: MIT
#pragma once

#include "app/base/progress.h"
#include "app/bench/figures.h"
#include "renderer/pipeline/renderer.h"

#include <string>
#include <vector>

namespace afterglow {

/// One moment of a scene, seen from its first camera, that is rendered repeatedly.
struct BenchFrames {
    Settings settings; ///< all but the filter
    std::uint32_t seed = 0;
    int frames = 16; ///< of each filter

    /// Returns the input of a frame.
    static FrameInput inputOf(const Scene& scene, std::uint32_t frame, std::uint32_t seed);
    Settings settingsOf(Filter filter) const;
};

/// The first frames of each round of a filter, in which it has no history and drivers compile.
inline constexpr int kWarmupFrames = 3;
/// The least number of frames of a filter: there must be one that counts.
inline constexpr int kLeastFrames = kWarmupFrames + 1;

struct PassFigure {
    std::string name;
    Spread milliseconds;
    double bytes = 0.0; ///< the least that it moves: PassBytes
};

/// The frames of one filter.
struct FilterFigures {
    Filter filter;
    Spread frame;                   ///< milliseconds
    Spread rays;                    ///< traced in a frame
    std::vector<PassFigure> passes; ///< in the order of the frame

    double sumMilliseconds() const; ///< of the medians of its passes
};

/// Measures the passes of filters, of a renderer whose timer is enabled. Their frames are rendered
/// in turns, a few of each, so that a machine that slows down slows down all of them.
std::vector<FilterFigures> measurePasses(Renderer& renderer, const BenchFrames& frames,
                                         std::span<const Filter> filters, Progress& progress);

/// Measures the bandwidth of a copy by a compute shader, GB/s: bytes read plus bytes written, of an
/// image of RGBA32F.
Spread measureCopy(ShaderLibrary& shaders, glm::ivec2 size, int repeats);

void addTo(Figures& figures, const std::string& subject, std::span<const FilterFigures> filters);

/// Returns the tables of the filters; `copy` is the bandwidth that shares are of.
std::string tableOf(std::span<const FilterFigures> filters, const Spread& copy);

} // namespace afterglow
