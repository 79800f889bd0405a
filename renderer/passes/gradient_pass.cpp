#include "renderer/passes/gradient_pass.h"

namespace afterglow {

GradientPass::GradientPass(ShaderLibrary& shaders)
    : merged_(shaders.compute("denoise/gradient.comp")),
      extra_(shaders.compute("denoise/gradient.comp", {{"EXTRA_SAMPLES", "1"}})) {}

void GradientPass::run(FrameContext& frame, const Inputs& in, const Outputs& out,
                       const gpu::GradientParams& params) {
    const auto scope = frame.pass("gradient", {&out.gradient});
    const auto dispatch = [&](ComputeProgram& program, std::initializer_list<Binding> reads) {
        program.dispatch(out.gradient.size(), params, reads,
                         {{"gradient", out.gradient},
                          {"strataGuides", out.strataGuides},
                          {"strataSlope", out.strataSlope}});
    };
    if (in.sampleRaw)
        dispatch(extra_, {{"raw", in.raw},
                          {"samples", in.samples},
                          {"guides", in.guides},
                          {"slope", in.slope},
                          {"sampleRaw", *in.sampleRaw}});
    else
        dispatch(
            merged_,
            {{"raw", in.raw}, {"samples", in.samples}, {"guides", in.guides}, {"slope", in.slope}});
}

GradientAtrousPass::GradientAtrousPass(ShaderLibrary& shaders, Kernel kernel)
    : program_(shaders.compute("denoise/gradient_atrous.comp", definesOf(kernel))) {}

void GradientAtrousPass::run(FrameContext& frame, const Inputs& in, const Outputs& out,
                             const gpu::EdgeStopping& params) {
    const auto scope = frame.pass("gradient a-trous", {&out.filtered});
    program_.dispatch(out.filtered.size(), params,
                      {{"gradient", in.gradient},
                       {"strataGuides", in.strataGuides},
                       {"strataSlope", in.strataSlope}},
                      {{"filtered", out.filtered}});
}

LambdaPass::LambdaPass(ShaderLibrary& shaders) : program_(shaders.compute("denoise/lambda.comp")) {}

void LambdaPass::run(FrameContext& frame, const Inputs& in, const Outputs& out,
                     const gpu::GradientParams& params) {
    const auto scope = frame.pass("lambda", {&out.lambda});
    program_.dispatch(out.lambda.size(), params, {{"gradient", in.gradient}},
                      {{"lambda", out.lambda}});
}

} // namespace afterglow
