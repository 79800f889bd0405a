// SPDX-License-Identifier: MIT
#include "renderer/passes/probe_pass.h"

#include "shared/instrument_params.h"

#include <array>
#include <stdexcept>
#include <vector>

namespace afterglow {
namespace {

/// Mean and sum of squared deviations, of two luminances at once.
struct Moments {
    double count = 0.0;
    glm::dvec2 mean{0.0}, squares{0.0};

    /// Chan, Golub and LeVeque 1979.
    void add(const Moments& other) {
        if (other.count == 0.0)
            return;
        const double together = count + other.count;
        const glm::dvec2 apart = other.mean - mean;
        mean += apart * (other.count / together);
        squares += other.squares + apart * apart * (count * other.count / together);
        count = together;
    }
};

} // namespace

ProbePass::ProbePass(ShaderLibrary& shaders) : shaders_(shaders) {}

void ProbePass::run(FrameContext& frame, const Inputs& in, glm::ivec2 min, glm::ivec2 size) {
    const glm::ivec2 picture = in.filtered.size();
    for (const GpuTexture* other : {&in.raw, &in.albedo, &in.guides, &in.control})
        if (other->size() != picture)
            throw std::logic_error("ProbePass: " + other->label() + " is not of the size of " +
                                   in.filtered.label());

    // In 64 bits: a rectangle may reach as far as numbers do.
    const auto inPicture = [&](glm::i64vec2 p) {
        return glm::ivec2(glm::clamp(p, glm::i64vec2(0), glm::i64vec2(picture)));
    };
    const gpu::ProbeParams params{inPicture(min),
                                  inPicture(glm::i64vec2(min) + glm::i64vec2(size))};
    const glm::ivec2 extent = params.end - params.first;
    blocks_ = glm::ivec2(0);
    if (extent.x <= 0 || extent.y <= 0)
        return;
    blocks_ = (extent + gpu::kInstrumentBlock - 1) / gpu::kInstrumentBlock;
    const glm::ivec2 texels = blocks_ * glm::ivec2(gpu::kProbeTexels, 1);
    if (sums_.size().x < texels.x || sums_.size().y < texels.y)
        sums_ = GpuTexture("probe sums", PixelFormat::RGBA32F, glm::max(texels, sums_.size()));

    // Compiled when it is first needed: most runs have no probes.
    ComputeProgram& program =
        shaders_.compute("post/probe.comp", in.other ? Defines{{"OTHER_SIGNAL", "1"}} : Defines{});
    const auto scope = frame.timer.scope(frame.prefix + "probe");
    std::vector<Binding> reads{{"filtered", in.filtered},
                               {"raw", in.raw},
                               {"albedo", in.albedo},
                               {"guides", in.guides},
                               {"control", in.control}};
    if (in.other) {
        reads.emplace_back("otherFiltered", in.other->filtered);
        reads.emplace_back("otherRaw", in.other->raw);
        reads.emplace_back("otherDemodulation", in.other->demodulation);
    }
    const std::array<Binding, 1> writes{Binding{"sums", sums_}};
    program.dispatch(blocks_ * glm::ivec2(program.groupSize()), params, reads, writes);
}

ProbePass::Region ProbePass::copyTo(PixelReadback& readback) const {
    if (blocks_ == glm::ivec2(0))
        return {};
    return readback.add<glm::vec4>(sums_, {0, 0}, blocks_ * glm::ivec2(gpu::kProbeTexels, 1));
}

ProbeReading ProbePass::read() const {
    PixelReadback readback;
    const Region region = copyTo(readback);
    readback.finish();
    return readingOf(readback, region);
}

ProbeReading ProbePass::readingOf(const PixelReadback& readback, const Region& region) {
    Moments raw;
    ProbeReading total;
    for (int y = 0; y < region.size.y; ++y)
        for (int x = 0; x < region.size.x; x += gpu::kProbeTexels) {
            const glm::dvec4 counted = readback.pixel(region, {x, y});
            const glm::dvec4 controlled = readback.pixel(region, {x + 1, y});
            const glm::dvec4 means = readback.pixel(region, {x + 2, y});
            raw.add(
                {counted.x, {means.x + means.z, means.y + means.w}, {controlled.z, controlled.w}});
            total.lit += counted.y;
            total.variance += counted.z;
            total.lambda += counted.w;
            total.alpha += controlled.x;
            total.history += controlled.y;
        }
    if (raw.count == 0.0)
        return {};
    return {.pixels = std::uint64_t(raw.count),
            .lit = total.lit / raw.count,
            .rawLit = raw.mean.y,
            .rawVariance = raw.squares.x / raw.count,
            .variance = total.variance / raw.count,
            .lambda = total.lambda / raw.count,
            .alpha = total.alpha / raw.count,
            .history = total.history / raw.count,
            .rawLitVariance = raw.squares.y / raw.count};
}

} // namespace afterglow
