// SPDX-License-Identifier: MIT
#include "app/bench/pass_bytes.h"

#include "renderer/pipeline/renderer.h"

#include <algorithm>
#include <numeric>

namespace afterglow {

namespace {

/// Returns the number of rays of the list whose counts are among the bindings.
double listedRays(std::span<const Binding> bindings) {
    const auto counts = std::ranges::find(bindings, "rayCounts", &Binding::name);
    if (counts == bindings.end() || !counts->buffer)
        return 0.0;
    const auto all = counts->buffer->read<std::uint32_t>();
    return std::accumulate(all.begin(), all.end(), 0.0);
}

} // namespace

double bytesOf(std::span<const Binding> bindings) {
    double bytes = 0.0;
    for (const Binding& binding : bindings) {
        if (binding.texture)
            bytes += double(binding.texture->bytes());
        else if (binding.array)
            bytes += double(binding.array->bytes());
        else if (binding.block)
            bytes += double(binding.block->bytes());
        else if (binding.name == "rays")
            bytes += listedRays(bindings) * gpu::kTexelsPerRay * sizeof(glm::uvec4);
        else if (binding.name == "rayCounts")
            bytes += double(binding.buffer->bytes());
    }
    return bytes;
}

PassBytes::PassBytes(Renderer& renderer) : renderer_(renderer) {
    renderer_.setListener(this);
    setDispatchListener(this);
}

PassBytes::~PassBytes() {
    setDispatchListener(nullptr);
    renderer_.setListener(nullptr);
}

void PassBytes::dispatched(std::span<const Binding> reads, std::span<const Binding> writes) {
    open_ += bytesOf(reads) + bytesOf(writes);
    dispatches_ = true;
}

void PassBytes::passDone(std::string_view pass, std::span<const GpuTexture* const> made) {
    if (!dispatches_) // the raster pass
        for (const GpuTexture* image : made)
            open_ += double(image->bytes());
    bytes_[std::string(pass)] += open_;
    open_ = 0.0;
    dispatches_ = false;
}

} // namespace afterglow
