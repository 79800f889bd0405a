// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/headless.h"
#include "renderer/pipeline/settings.h"

#include <optional>
#include <string>
#include <vector>

namespace afterglow {

/// What `afterglow bench` was asked for.
struct BenchOptions {
    std::string scene = "hall";
    std::vector<Filter> filters; ///< empty: all
    std::vector<glm::ivec2> sizes{{640, 360}};
    Settings settings;
    int frames = 16; ///< of each filter at each size, the first three only warm up
    std::uint32_t seed = 0;
    ContextWish context;
    std::optional<std::string> out; ///< a folder for bench.json
};

/// Renders every filter at every size and prints medians per pass and frame.
void runBench(const BenchOptions& options, HiddenContextFactory hiddenContext);

} // namespace afterglow
