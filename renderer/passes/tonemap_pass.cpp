// SPDX-License-Identifier: MIT
#include "renderer/passes/tonemap_pass.h"

namespace afterglow {
namespace {

Defines definesFor(int toneMapper) {
    return {{"TONE_MAPPER", std::to_string(toneMapper)}};
}

} // namespace

TonemapPass::TonemapPass(ShaderLibrary& shaders) : shaders_(shaders) {
    shaders_.compute("post/tonemap.comp", definesFor(gpu::kToneAces));
}

void TonemapPass::run(FrameContext& frame, const GpuTexture& composed, GpuTexture& display,
                      int toneMapper, const gpu::TonemapParams& params) {
    const auto scope = frame.pass("tone map", {&display});
    shaders_.compute("post/tonemap.comp", definesFor(toneMapper))
        .dispatch(display.size(), params, {frame.block(), {"composed", composed}},
                  {{"display", display}});
}

} // namespace afterglow
