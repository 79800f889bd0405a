// SPDX-License-Identifier: MIT
#pragma once

#include "app/bench/figures.h"
#include "renderer/pipeline/renderer.h"

#include <string>
#include <utility>
#include <vector>

namespace afterglow {

/// Bytes on the device by who owns them, of a filter and a size.
struct MemoryFigures {
    Filter filter;
    glm::ivec2 size;
    std::vector<std::pair<std::string, std::size_t>> owners; ///< "frame", "signals", ...

    std::size_t total() const;
};

/// Counts what a renderer has now; a frame has been rendered.
MemoryFigures countMemory(Renderer& renderer, Filter filter);

void addTo(Figures& figures, const std::string& subject, const MemoryFigures& memory);
std::string tableOf(std::span<const MemoryFigures> filters);

} // namespace afterglow
