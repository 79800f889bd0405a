// SPDX-License-Identifier: MIT
#include "renderer/passes/variance_pass.h"

namespace afterglow {

VariancePass::VariancePass(ShaderLibrary& shaders)
    : program_(shaders.compute("denoise/variance.comp")) {}

void VariancePass::run(FrameContext& frame, const Inputs& in, const Outputs& out,
                       const gpu::VarianceParams& params) {
    const auto scope = frame.pass("variance", {&out.filtered});
    program_.dispatch(out.filtered.size(), params,
                      {{"accumulated", in.accumulated},
                       {"moments", in.moments},
                       {"guides", in.guides},
                       {"slope", in.slope}},
                      {{"filtered", out.filtered}});
}

} // namespace afterglow
