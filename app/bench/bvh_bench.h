// SPDX-License-Identifier: MIT
#pragma once

#include "app/bench/figures.h"
#include "renderer/scene/scene.h"

#include <optional>
#include <string>

namespace afterglow {

/// The build and refit times of trees, and their SAH cost.
struct BvhFigures {
    unsigned threads = 1;
    std::size_t triangles = 0, bytes = 0;
    std::uint32_t depth = 0; ///< nodes on the longest path
    Spread scene; ///< milliseconds of SceneBvh: corners moved into the world, trees, joined
    Spread build; ///< of one tree over all triangles, where they lie in the world
    Spread refit; ///< of all its boxes, in one thread
    double sahCost = 0.0;
    struct Embree {
        Spread build;
        double sahCost = 0.0;
    };
    std::optional<Embree> embree; ///< over the same triangles; empty: not built with it
};

/// Measures, ours and Embree's in turns.
BvhFigures measureBvh(const Scene& scene, int repeats);

void addTo(Figures& figures, const std::string& subject, const BvhFigures& bvh);
std::string tableOf(const BvhFigures& bvh);

} // namespace afterglow
