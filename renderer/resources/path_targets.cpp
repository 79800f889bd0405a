// SPDX-License-Identifier: MIT
#include "renderer/resources/path_targets.h"

namespace afterglow {

PathTargets::PathTargets(glm::ivec2 size) : bounces(size) {
    const glm::ivec2 segments = segmentsOf(size);
    hits = TexelBuffer("bounce hits", std::size_t(segments.x) * std::size_t(segments.y) *
                                          gpu::kSegmentRays * sizeof(glm::uvec4));
    distances = GpuTexture("path distances", PixelFormat::R32F, size);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        weights[i] = GpuTexture("path weight", PixelFormat::RGBA32F, size);
        pending[i] = GpuTexture("path pending", PixelFormat::RGBA32F, size);
    }
}

std::vector<const GpuTexture*> PathTargets::all() const {
    std::vector<const GpuTexture*> images;
    if (empty())
        return images;
    images.push_back(&distances);
    for (std::size_t i = 0; i < weights.size(); ++i)
        images.insert(images.end(), {&weights[i], &pending[i]});
    return images;
}

} // namespace afterglow
