// SPDX-License-Identifier: MIT
#include "renderer/passes/reference_pass.h"

namespace afterglow {

ReferencePass::ReferencePass(ShaderLibrary& shaders)
    : accumulate_(shaders.compute("lighting/accumulate.comp")),
      accumulateLast_(shaders.compute("lighting/accumulate.comp", {{"NEXT_SEEDS", "1"}})),
      mean_(shaders.compute("lighting/mean.comp")) {}

void ReferencePass::add(FrameContext& frame, const GpuTexture& raw, const Sums& to,
                        GpuTexture* seeds) {
    const auto scope = frame.pass("accumulate", {&to.sum});
    if (seeds)
        accumulateLast_.dispatch(to.sum.size(), {frame.block(), {"raw", raw}},
                                 {{"seeds", *seeds}, {"sum", to.sum}, {"lost", to.lost}});
    else
        accumulate_.dispatch(to.sum.size(), {frame.block(), {"raw", raw}},
                             {{"sum", to.sum}, {"lost", to.lost}});
}

void ReferencePass::mean(FrameContext& frame, const GpuTexture& sum, int samples,
                         GpuTexture& mean) {
    mean_.dispatch(mean.size(), gpu::MeanParams{1.0f / float(samples), 0.0f, 0.0f, 0.0f},
                   {frame.block(), {"sum", sum}}, {{"mean", mean}});
}

} // namespace afterglow
