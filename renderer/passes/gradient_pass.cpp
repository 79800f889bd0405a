#include "renderer/passes/gradient_pass.h"

namespace afterglow {

GradientPass::GradientPass(ShaderLibrary& shaders)
    : program_(shaders.compute("denoise/gradient.comp")) {}

void GradientPass::run(FrameContext& frame, const Inputs& in, const Outputs& out,
                       const gpu::GradientParams& params) {
    const auto scope = frame.timer.scope("gradient");
    program_.dispatch(
        out.gradient.size(), params,
        {{"raw", in.raw}, {"samples", in.samples}, {"guides", in.guides}, {"slope", in.slope}},
        {{"gradient", out.gradient},
         {"strataGuides", out.strataGuides},
         {"strataSlope", out.strataSlope}});
}

GradientAtrousPass::GradientAtrousPass(ShaderLibrary& shaders, Kernel kernel)
    : program_(shaders.compute("denoise/gradient_atrous.comp", definesOf(kernel))) {}

void GradientAtrousPass::run(FrameContext& frame, const Inputs& in, const Outputs& out,
                             const gpu::EdgeStopping& params) {
    const auto scope = frame.timer.scope("gradient a-trous");
    program_.dispatch(out.filtered.size(), params,
                      {{"gradient", in.gradient},
                       {"strataGuides", in.strataGuides},
                       {"strataSlope", in.strataSlope}},
                      {{"filtered", out.filtered}});
}

LambdaPass::LambdaPass(ShaderLibrary& shaders) : program_(shaders.compute("denoise/lambda.comp")) {}

void LambdaPass::run(FrameContext& frame, const Inputs& in, const Outputs& out,
                     const gpu::GradientParams& params) {
    const auto scope = frame.timer.scope("lambda");
    program_.dispatch(out.lambda.size(), params, {{"gradient", in.gradient}},
                      {{"lambda", out.lambda}});
}

} // namespace afterglow
