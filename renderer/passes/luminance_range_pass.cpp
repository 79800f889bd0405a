// SPDX-License-Identifier: MIT
#include "renderer/passes/luminance_range_pass.h"

namespace afterglow {

LuminanceRangePass::LuminanceRangePass(ShaderLibrary& shaders)
    : program_(shaders.compute("denoise/luminance_range.comp")) {}

void LuminanceRangePass::run(FrameContext& frame, const Inputs& in, const Outputs& out,
                             const gpu::PercentileParams& params) {
    const auto scope = frame.pass("luminance range", {&out.luminanceRange});
    program_.dispatch(in.raw.size(), params, {{"raw", in.raw}, {"guides", in.guides}},
                      {{"luminanceRange", out.luminanceRange}});
}

} // namespace afterglow
