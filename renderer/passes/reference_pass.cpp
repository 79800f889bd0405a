#include "renderer/passes/reference_pass.h"

namespace afterglow {

ReferencePass::ReferencePass(ShaderLibrary& shaders)
    : accumulate_(shaders.compute("lighting/accumulate.comp")),
      mean_(shaders.compute("lighting/mean.comp")) {}

void ReferencePass::add(FrameContext& frame, const GpuTexture& raw, const Sums& to) {
    const auto scope = frame.pass("accumulate", {&to.sum});
    accumulate_.dispatch(to.sum.size(), {{"raw", raw}},
                         {{"seeds", to.seeds}, {"sum", to.sum}, {"lost", to.lost}});
}

void ReferencePass::mean(FrameContext&, const GpuTexture& sum, int samples, GpuTexture& mean) {
    mean_.dispatch(mean.size(), gpu::MeanParams{1.0f / float(samples), 0.0f, 0.0f, 0.0f},
                   {{"sum", sum}}, {{"mean", mean}});
}

} // namespace afterglow
