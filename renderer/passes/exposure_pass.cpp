// SPDX-License-Identifier: MIT
#include "renderer/passes/exposure_pass.h"

namespace afterglow {

void ExposurePass::run(FrameContext& frame, const Inputs& in, const Outputs& out,
                       const gpu::ExposureParams& params) {
    const auto scope = frame.pass("exposure", {&out.exposure});
    shaders_.compute("post/log_luminance.comp")
        .dispatch(out.sums.size(), {{"composed", in.composed}, {"guides", in.guides}},
                  {{"sums", out.sums}});
    ComputeProgram& adapt = shaders_.compute("post/exposure.comp");
    adapt.dispatch(glm::ivec2(adapt.groupSize()), params,
                   {frame.block(), {"sums", out.sums}, {"previousExposure", in.previousExposure}},
                   {{"exposure", out.exposure}});
}

} // namespace afterglow
