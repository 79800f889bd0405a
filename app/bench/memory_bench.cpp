// SPDX-License-Identifier: MIT
#include "app/bench/memory_bench.h"

#include "app/bench/text_table.h"
#include "renderer/filters/filter_table.h"

#include <fmt/format.h>

namespace afterglow {

namespace {

std::size_t bytesOfAll(const std::vector<const GpuTexture*>& images) {
    std::size_t bytes = 0;
    for (const GpuTexture* image : images)
        bytes += image->bytes();
    return bytes;
}

} // namespace

std::size_t MemoryFigures::total() const {
    std::size_t bytes = 0;
    for (const auto& owner : owners)
        bytes += owner.second;
    return bytes;
}

MemoryFigures countMemory(Renderer& renderer, Filter filter) {
    const RenderTargets& targets = renderer.targets();
    const SceneGpu& scene = renderer.lightingCall(0).scene;
    std::size_t signals = 0, filters = 0;
    for (const SignalTargets& signal : targets.signals)
        signals += bytesOfAll(signal.all());
    for (const FilterTargets& state : targets.filters)
        if (!state.empty())
            filters += bytesOfAll(state.all());
    std::size_t sceneBytes =
        scene.vertexBuffer().bytes() + scene.indexBuffer().bytes() + scene.noiseTile.bytes();
    for (const TexelBuffer* buffer : {&scene.vertices, &scene.triangles, &scene.instances,
                                      &scene.materials, &scene.lightTriangles, &scene.lightScales})
        sceneBytes += buffer->bytes();
    return {.filter = filter,
            .size = targets.size,
            .owners = {{"frame", targets.bytes() - signals - filters - targets.rays.bytes()},
                       {"signals", signals},
                       {"filter", filters},
                       {"ray list", targets.rays.bytes()},
                       {"scene", sceneBytes},
                       {"bvh", scene.bvhRecords.bytes()}}};
}

void addTo(Figures& figures, const std::string& subject, const MemoryFigures& memory) {
    const std::string own = subject + "/" + std::string(nameOf(memory.filter));
    for (const auto& [owner, bytes] : memory.owners)
        figures.add(own, "memory." + owner + ".bytes", "bytes", Better::Less,
                    exactly(double(bytes)));
    figures.add(own, "memory.total.bytes", "bytes", Better::Less, exactly(double(memory.total())));
}

std::string tableOf(std::span<const MemoryFigures> filters) {
    if (filters.empty())
        return {};
    std::vector<std::string> head{"memory"};
    for (const auto& owner : filters.front().owners)
        head.push_back(owner.first);
    head.insert(head.end(), {"all", "bytes a pixel"});
    TextTable table(head);
    for (const MemoryFigures& memory : filters) {
        std::vector<std::string> row{std::string(nameOf(memory.filter))};
        double images = 0.0;
        for (const auto& [owner, bytes] : memory.owners) {
            row.push_back(bytesText(double(bytes)));
            images += owner == "scene" || owner == "bvh" ? 0.0 : double(bytes);
        }
        row.push_back(bytesText(double(memory.total())));
        row.push_back(fmt::format("{:.0f}", images / (double(memory.size.x) * memory.size.y)));
        table.add(std::move(row));
    }
    return table.text() + "  bytes a pixel: without scene and bvh\n\n";
}

} // namespace afterglow
