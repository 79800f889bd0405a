// SPDX-License-Identifier: MIT
#pragma once

#include "app/base/progress.h"
#include "app/bench/figures.h"
#include "app/bench/ray_lists.h"

#include <optional>
#include <string>
#include <vector>

namespace afterglow {

/// The tracing rate of one kind of ray.
struct RayFigures {
    RayKind kind;
    std::size_t rays = 0, hits = 0;
    Spread milliseconds;
    struct Embree {
        Spread milliseconds;
        std::size_t disagreements = 0; ///< rays that hit something for one of both alone
    };
    std::optional<Embree> embree; ///< of the very same rays; empty: not built with it

    Spread raysPerSecond() const; ///< Mrays/s
    std::optional<Spread> embreeRaysPerSecond() const;
};

/// Returns the number of threads that Mesa's software renderer has: LP_NUM_THREADS, else those of
/// the machine. Embree gets as many.
unsigned tracingThreads();

/// Measures each kind of ray on the last frame of a renderer, ours and Embree's in turns.
std::vector<RayFigures> measureRays(Renderer& renderer, ShaderLibrary& shaders, int repeats,
                                    Progress& progress);

void addTo(Figures& figures, const std::string& subject, std::span<const RayFigures> kinds);
std::string tableOf(std::span<const RayFigures> kinds, bool onCpu);

} // namespace afterglow
