#include "renderer/passes/temporal_pass.h"

namespace afterglow {

TemporalPass::TemporalPass(ShaderLibrary& shaders)
    : program_(shaders.compute("denoise/temporal.comp")) {}

void TemporalPass::run(FrameContext& frame, const Inputs& in, const Outputs& out,
                       const gpu::TemporalParams& params) {
    const auto scope = frame.pass("temporal", {&out.accumulated, &out.moments, &out.control});
    program_.dispatch(
        out.accumulated.size(), params,
        {frame.block(),
         {"raw", in.raw},
         {"visibility", in.visibility},
         {"previousVisibility", in.previousVisibility},
         {"guides", in.guides},
         {"previousGuides", in.previousGuides},
         {"slope", in.slope},
         {"motion", in.motion},
         {"previousColor", in.previousColor},
         {"previousMoments", in.previousMoments},
         {"lambda", in.lambda},
         {"luminanceRange", in.luminanceRange}},
        {{"accumulated", out.accumulated}, {"moments", out.moments}, {"control", out.control}});
}

} // namespace afterglow
