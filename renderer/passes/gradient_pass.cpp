#include "renderer/passes/gradient_pass.h"

namespace afterglow {

StrataPass::StrataPass(ShaderLibrary& shaders) : program_(shaders.compute("denoise/strata.comp")) {}

void StrataPass::run(FrameContext& frame, const Inputs& in, const Outputs& out) {
    const auto scope = frame.pass("strata", {&out.strataGuides, &out.strataSlope});
    program_.dispatch(out.strataGuides.size(), {{"guides", in.guides}, {"slope", in.slope}},
                      {{"strataGuides", out.strataGuides}, {"strataSlope", out.strataSlope}});
}

GradientPass::GradientPass(ShaderLibrary& shaders)
    : merged_(shaders.compute("denoise/gradient.comp")),
      extra_(shaders.compute("denoise/gradient.comp", {{"EXTRA_SAMPLES", "1"}})) {}

void GradientPass::run(FrameContext& frame, const Inputs& in, const Outputs& out,
                       const gpu::GradientParams& params) {
    const auto scope = frame.pass("gradient", {&out.gradient});
    if (in.sampleRaw)
        extra_.dispatch(out.gradient.size(), params,
                        {{"raw", in.raw},
                         {"previousRaw", in.previousRaw},
                         {"samples", in.samples},
                         {"guides", in.guides},
                         {"sampleRaw", *in.sampleRaw}},
                        {{"gradient", out.gradient}});
    else
        merged_.dispatch(out.gradient.size(), params,
                         {{"raw", in.raw},
                          {"previousRaw", in.previousRaw},
                          {"samples", in.samples},
                          {"guides", in.guides}},
                         {{"gradient", out.gradient}});
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
