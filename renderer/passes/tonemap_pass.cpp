// SPDX-License-Identifier: MIT
#include "renderer/passes/tonemap_pass.h"

namespace afterglow {

TonemapPass::TonemapPass(ShaderLibrary& shaders) : program_(shaders.compute("post/tonemap.comp")) {}

void TonemapPass::run(FrameContext& frame, const GpuTexture& composed, GpuTexture& display,
                      const gpu::TonemapParams& params) {
    const auto scope = frame.pass("tone map", {&display});
    program_.dispatch(display.size(), params, {frame.block(), {"composed", composed}},
                      {{"display", display}});
}

} // namespace afterglow
