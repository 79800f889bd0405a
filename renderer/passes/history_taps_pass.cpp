#include "renderer/passes/history_taps_pass.h"

#include <stdexcept>

namespace afterglow {

HistoryTapsPass::HistoryTapsPass(ShaderLibrary& shaders)
    : shaders_(shaders), taps_("history taps", PixelFormat::RGBA32UI,
                               {gpu::kHistoryTaps + 1, gpu::kHistoryTapTexels}) {}

void HistoryTapsPass::run(FrameContext& frame, const Inputs& in, glm::ivec2 pixel) {
    const glm::ivec2 picture = in.motion.size();
    for (const GpuTexture* other : {&in.visibility, &in.guides, &in.moments, &in.raw})
        if (other->size() != picture)
            throw std::logic_error("HistoryTapsPass: " + other->label() +
                                   " is not of the size of " + in.motion.label());
    if (glm::any(glm::lessThan(pixel, glm::ivec2(0))) ||
        glm::any(glm::greaterThanEqual(pixel, picture)))
        throw std::logic_error("HistoryTapsPass: the pixel is outside the picture");
    // Compiled when it is first needed: most runs inspect nothing.
    ComputeProgram& program = shaders_.compute("post/history_taps.comp");
    const auto scope = frame.timer.scope(frame.prefix + "history taps");
    program.dispatch(taps_.size(), gpu::HistoryTapsParams{pixel, {}},
                     {{"motion", in.motion},
                      {"samples", in.samples},
                      {"visibility", in.visibility},
                      {"guides", in.guides},
                      {"moments", in.moments},
                      {"raw", in.raw}},
                     {{"taps", taps_}});
}

HistoryTapsPass::Region HistoryTapsPass::copyTo(PixelReadback& readback) const {
    return readback.add<glm::uvec4>(taps_, {0, 0}, taps_.size());
}

HistoryTapsPass::Past HistoryTapsPass::pastOf(const PixelReadback& readback, const Region& region) {
    Past past;
    for (int i = 0; i < gpu::kHistoryTaps; ++i)
        past.taps[std::size_t(i)] = {readback.pixel(region, {i, 0}).x,
                                     glm::uintBitsToFloat(readback.pixel(region, {i, 1})),
                                     glm::uintBitsToFloat(readback.pixel(region, {i, 2}))};
    past.sampleRaw = glm::uintBitsToFloat(readback.pixel(region, {gpu::kHistoryTaps, 0}));
    return past;
}

} // namespace afterglow
