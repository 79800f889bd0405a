// SPDX-License-Identifier: MIT
#include "renderer/passes/atrous_pass.h"

namespace afterglow {

AtrousPass::AtrousPass(ShaderLibrary& shaders, Kernel kernel)
    : program_(shaders.compute("denoise/atrous.comp", definesOf(kernel))) {}

void AtrousPass::run(FrameContext& frame, const Inputs& in, const Outputs& out,
                     const gpu::EdgeStopping& params) {
    const auto scope = frame.pass("a-trous", {&out.filtered});
    program_.dispatch(out.filtered.size(), params,
                      {{"signal", in.signal}, {"guides", in.guides}, {"slope", in.slope}},
                      {{"filtered", out.filtered}});
}

} // namespace afterglow
