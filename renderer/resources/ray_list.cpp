// SPDX-License-Identifier: MIT
#include "renderer/resources/ray_list.h"

namespace afterglow {

RayList::RayList(glm::ivec2 size) {
    const glm::ivec2 segments = segmentsOf(size);
    const auto count = std::size_t(segments.x) * std::size_t(segments.y);
    rays = TexelBuffer("rays", count * gpu::kSegmentRays * gpu::kTexelsPerRay * sizeof(glm::uvec4));
    counts = TexelBuffer("ray counts", count * sizeof(std::uint32_t), PixelFormat::R32UI);
}

glm::ivec2 segmentsOf(glm::ivec2 size) {
    return (size + int(gpu::kSegmentSize) - 1) / int(gpu::kSegmentSize);
}

glm::ivec2 invocationsOf(glm::ivec2 size) {
    const glm::ivec2 segments = segmentsOf(size);
    return {segments.x * int(gpu::kSegmentRays), segments.y};
}

} // namespace afterglow
