// SPDX-License-Identifier: MIT
#include "renderer/passes/tonemap_pass.h"

#include <array>
#include <string>
#include <vector>

namespace afterglow {
namespace {

Defines definesFor(int toneMapper, bool autoExposure) {
    Defines defines{{"TONE_MAPPER", std::to_string(toneMapper)}};
    if (autoExposure)
        defines.emplace_back("AUTO_EXPOSURE", "1");
    return defines;
}

} // namespace

TonemapPass::TonemapPass(ShaderLibrary& shaders) : shaders_(shaders) {
    shaders_.compute("post/tonemap.comp", definesFor(gpu::kToneAces, false));
}

void TonemapPass::run(FrameContext& frame, const Inputs& in, GpuTexture& display, int toneMapper,
                      const gpu::TonemapParams& params) {
    const auto scope = frame.pass("tone map", {&display});
    std::vector<Binding> reads{frame.block(), {"composed", in.composed}};
    if (in.exposure)
        reads.emplace_back("exposure", *in.exposure);
    const std::array<Binding, 1> writes{Binding{"display", display}};
    shaders_.compute("post/tonemap.comp", definesFor(toneMapper, in.exposure != nullptr))
        .dispatch(display.size(), params, reads, writes);
}

} // namespace afterglow
