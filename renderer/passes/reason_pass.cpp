// SPDX-License-Identifier: MIT
#include "renderer/passes/reason_pass.h"

#include <algorithm>
#include <stdexcept>

namespace afterglow {
namespace {

glm::ivec2 threadsOver(const GpuTexture& image, const ComputeProgram& program) {
    const glm::ivec2 blocks = (image.size() + gpu::kInstrumentBlock - 1) / gpu::kInstrumentBlock;
    return blocks * glm::ivec2(program.groupSize());
}

} // namespace

ReasonPass::ReasonPass(ShaderLibrary& shaders)
    : shaders_(shaders),
      counts_("reason counts", PixelFormat::R32UI, {int(gpu::kHistoryBins + gpu::kFateBins), 1}) {
    counts_.clear();
}

void ReasonPass::run(FrameContext& frame, const Inputs& in) {
    if (in.control.size() != in.guides.size())
        throw std::logic_error("ReasonPass: " + in.control.label() + " is not of the size of " +
                               in.guides.label());
    // Compiled when they are first needed: most runs count nothing.
    ComputeProgram& history = shaders_.compute("post/reasons.comp");
    const auto scope = frame.timer.scope(frame.prefix + "reasons");
    counts_.clear();
    history.dispatch(threadsOver(in.control, history),
                     {{"control", in.control}, {"guides", in.guides}}, {{"counts", counts_}});
    if (!in.samples)
        return;
    ComputeProgram& fates = shaders_.compute("post/reasons.comp", {{"FATES", "1"}});
    fates.dispatch(threadsOver(*in.samples, fates), {{"samples", *in.samples}},
                   {{"counts", counts_}});
}

ReasonPass::Region ReasonPass::copyTo(PixelReadback& readback) const {
    return readback.add<std::uint32_t>(counts_, {0, 0}, counts_.size());
}

ReasonCounts ReasonPass::read() const {
    PixelReadback readback;
    const Region region = copyTo(readback);
    readback.finish();
    return countsOf(readback, region);
}

ReasonCounts ReasonPass::countsOf(const PixelReadback& readback, const Region& region) {
    ReasonCounts result;
    const auto bins = readback.pixels(region);
    std::ranges::copy(bins.first(gpu::kHistoryBins), result.history.begin());
    std::ranges::copy(bins.subspan(gpu::kHistoryBins), result.fates.begin());
    return result;
}

} // namespace afterglow
