// SPDX-License-Identifier: MIT
#include "renderer/passes/temporal_pass.h"

namespace afterglow {
namespace {

std::array<Binding, 12> readsOf(const FrameContext& frame, const TemporalPass::Inputs& in) {
    return {frame.block(),
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
            {"luminanceRange", in.luminanceRange}};
}

} // namespace

TemporalPass::TemporalPass(ShaderLibrary& shaders)
    : shaders_(shaders), program_(shaders.compute("denoise/temporal.comp")) {}

void TemporalPass::run(FrameContext& frame, const Inputs& in, const Outputs& out,
                       const gpu::TemporalParams& params) {
    const auto scope = frame.pass("temporal", {&out.accumulated, &out.moments, &out.control});
    const std::array<Binding, 3> writes{Binding{"accumulated", out.accumulated},
                                        {"moments", out.moments},
                                        {"control", out.control}};
    program_.dispatch(out.accumulated.size(), params, readsOf(frame, in), writes);
}

TemporalPass::Findings::Region TemporalPass::inspect(FrameContext& frame, const Inputs& in,
                                                     const gpu::TemporalParams& params,
                                                     glm::ivec2 pixel, PixelReadback& readback) {
    // Compiled when it is first needed: most runs inspect nothing.
    ComputeProgram& program = shaders_.compute("denoise/temporal.comp", inspecting());
    const std::array<Binding, 1> writes{findings_.start(pixel, in.raw.size())};
    const auto scope = frame.timer.scope(frame.prefix + "inspect temporal");
    program.dispatch(glm::ivec2(1), params, readsOf(frame, in), writes);
    return findings_.copyTo(readback);
}

} // namespace afterglow
