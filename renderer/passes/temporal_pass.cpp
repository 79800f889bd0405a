// SPDX-License-Identifier: MIT
#include "renderer/passes/temporal_pass.h"

#include <array>
#include <string>
#include <vector>

namespace afterglow {
namespace {

constexpr const char* kShader = "denoise/temporal.comp";

std::vector<Binding> readsOf(const FrameContext& frame, const TemporalPass::Inputs& in) {
    return {frame.block(),
            {"raw", in.raw},
            {"visibility", in.visibility},
            {"previousVisibility", in.previousVisibility},
            {"guides", in.guides},
            {"previousGuides", in.previousGuides},
            {"slope", in.slope},
            {"motion", in.motion},
            {"previousColor", in.previousColor},
            {"previousMoments", in.previousMoments}};
}

bool readsChange(const gpu::TemporalParams& params) {
    return params.lambdaUse == gpu::kLambdaCounts ||
           (params.lambdaSource == gpu::kLambdaFromGradient &&
            params.lambdaFetch == gpu::kLambdaLight);
}

/// Returns what compiles the shader for a plan. What has no effect has one value, so that plans
/// share a program where they can.
Defines definesFor(const gpu::TemporalParams& params) {
    const bool fromGradient = params.lambdaSource == gpu::kLambdaFromGradient;
    Defines defines{{"FOR_PLAN", "1"},
                    {"LAMBDA_SOURCE", std::to_string(params.lambdaSource)},
                    {"LAMBDA_FETCH", std::to_string(fromGradient ? params.lambdaFetch : 0)},
                    {"LAMBDA_USE", std::to_string(params.lambdaUse)},
                    {"HISTORY_LAW", std::to_string(params.historyLaw)},
                    {"CLAMP_RADIUS", params.clampRadius < 0 ? "-1" : "params.clampRadius"}};
    if (readsChange(params))
        defines.emplace_back("READS_CHANGE", "1");
    if (params.lambdaUse == gpu::kLambdaCounts)
        defines.emplace_back("COUNTS", "1");
    return defines;
}

} // namespace

TemporalPass::TemporalPass(ShaderLibrary& shaders) : shaders_(shaders) {}

void TemporalPass::prepare(const gpu::TemporalParams& params) {
    shaders_.compute(kShader, definesFor(params));
}

void TemporalPass::run(FrameContext& frame, const Inputs& in, const Outputs& out,
                       const gpu::TemporalParams& params) {
    const auto scope = frame.pass("temporal", {&out.accumulated, &out.moments, &out.control});
    const std::array<Binding, 3> writes{Binding{"accumulated", out.accumulated},
                                        {"moments", out.moments},
                                        {"control", out.control}};
    std::vector<Binding> reads = readsOf(frame, in);
    if (params.lambdaSource == gpu::kLambdaFromGradient)
        reads.emplace_back("lambda", in.lambda);
    if (params.lambdaSource == gpu::kLambdaFromRange)
        reads.emplace_back("luminanceRange", in.luminanceRange);
    if (readsChange(params))
        reads.emplace_back("change", in.change);
    if (params.lambdaUse == gpu::kLambdaCounts) {
        reads.emplace_back("changed", in.changed);
        reads.emplace_back("samples", in.samples);
    }
    shaders_.compute(kShader, definesFor(params))
        .dispatch(out.accumulated.size(), params, reads, writes);
}

TemporalPass::Findings::Region TemporalPass::inspect(FrameContext& frame, const Inputs& in,
                                                     const gpu::TemporalParams& params,
                                                     glm::ivec2 pixel, PixelReadback& readback) {
    // Compiled when it is first needed, for all plans: most runs inspect nothing.
    ComputeProgram& program = shaders_.compute(kShader, inspecting());
    std::vector<Binding> reads = readsOf(frame, in);
    reads.emplace_back("lambda", in.lambda);
    reads.emplace_back("luminanceRange", in.luminanceRange);
    reads.emplace_back("change", in.change);
    reads.emplace_back("changed", in.changed);
    reads.emplace_back("samples", in.samples);
    const std::array<Binding, 1> writes{findings_.start(pixel, in.raw.size())};
    const auto scope = frame.timer.scope(frame.prefix + "inspect temporal");
    program.dispatch(glm::ivec2(1), params, reads, writes);
    return findings_.copyTo(readback);
}

} // namespace afterglow
