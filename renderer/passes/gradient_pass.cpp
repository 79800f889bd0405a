// SPDX-License-Identifier: MIT
#include "renderer/passes/gradient_pass.h"

namespace afterglow {

StrataPass::StrataPass(ShaderLibrary& shaders) : program_(shaders.compute("denoise/strata.comp")) {}

void StrataPass::run(FrameContext& frame, const Inputs& in, const Outputs& out) {
    const auto scope = frame.pass("strata", {&out.strataGuides, &out.strataSlope});
    program_.dispatch(out.strataGuides.size(), {{"guides", in.guides}, {"slope", in.slope}},
                      {{"strataGuides", out.strataGuides}, {"strataSlope", out.strataSlope}});
}

namespace {

const Defines kExtra{{"EXTRA_SAMPLES", "1"}};

} // namespace

std::vector<Binding> GradientPass::Inputs::bindings() const {
    std::vector<Binding> reads{
        {"raw", raw}, {"previousRaw", previousRaw}, {"samples", samples}, {"guides", guides}};
    if (sampleRaw)
        reads.emplace_back("sampleRaw", *sampleRaw);
    return reads;
}

Defines GradientPass::Inputs::defines() const {
    return sampleRaw ? kExtra : Defines{};
}

GradientPass::GradientPass(ShaderLibrary& shaders)
    : shaders_(shaders), merged_(shaders.compute("denoise/gradient.comp")),
      extra_(shaders.compute("denoise/gradient.comp", kExtra)) {}

void GradientPass::run(FrameContext& frame, const Inputs& in, const Outputs& out,
                       const gpu::GradientParams& params) {
    const auto scope = frame.pass("gradient", {&out.gradient});
    const std::array<Binding, 1> writes{Binding{"gradient", out.gradient}};
    (in.sampleRaw ? extra_ : merged_).dispatch(out.gradient.size(), params, in.bindings(), writes);
}

GradientPass::Findings::Region GradientPass::inspect(FrameContext& frame, const Inputs& in,
                                                     const gpu::GradientParams& params,
                                                     glm::ivec2 stratum, PixelReadback& readback) {
    ComputeProgram& program = shaders_.compute("denoise/gradient.comp", inspecting(in.defines()));
    const std::array<Binding, 1> writes{findings_.start(stratum, in.samples.size())};
    const auto scope = frame.timer.scope(frame.prefix + "inspect gradient");
    program.dispatch(glm::ivec2(1), params, in.bindings(), writes);
    return findings_.copyTo(readback);
}

namespace {

ComputeProgram& atrousProgram(ShaderLibrary& shaders, Kernel kernel,
                              const gpu::EdgeStopping& params) {
    return shaders.compute("denoise/gradient_atrous.comp", definesOf(kernel, params.sigmaNormal));
}

} // namespace

void GradientAtrousPass::prepare(const gpu::EdgeStopping& params) {
    atrousProgram(shaders_, kernel_, params);
}

void GradientAtrousPass::run(FrameContext& frame, const Inputs& in, const Outputs& out,
                             const gpu::EdgeStopping& params) {
    const auto scope = frame.pass("gradient a-trous", {&out.filtered});
    atrousProgram(shaders_, kernel_, params)
        .dispatch(out.filtered.size(), params,
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
