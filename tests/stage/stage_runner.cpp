// SPDX-License-Identifier: MIT
#include "tests/stage/stage_runner.h"

#include <array>
#include <optional>

#include "renderer/gl/buffer.h"
#include "renderer/passes/atrous_pass.h"
#include "renderer/passes/change_pass.h"
#include "renderer/passes/gradient_pass.h"
#include "renderer/passes/luminance_range_pass.h"
#include "renderer/passes/temporal_pass.h"
#include "renderer/passes/variance_pass.h"
#include "shared/frame.h"
#include "tests/reference/luminance_range.h"
#include "tests/stage/upload.h"

namespace afterglow::test {
namespace {

template <class Pixel>
GpuTexture output(std::string_view label, glm::ivec2 size) {
    return upload(label, Image<Pixel>(size, Pixel(-1234.5f)));
}

struct LightPairTextures {
    explicit LightPairTextures(glm::ivec2 strata)
        : before(output<glm::vec4>("before", strata)), now(output<glm::vec4>("now", strata)),
          products(output<glm::vec4>("products", strata)) {}
    explicit LightPairTextures(const RandomFrame& frame)
        : before(upload("before", frame.before)), now(upload("now", frame.now)),
          products(upload("products", frame.products)) {}

    LightPairs pairs() { return {before, now, products}; }
    LightPairImages read(std::uint32_t changed = 0) const {
        return {before.read<glm::vec4>(), now.read<glm::vec4>(), products.read<glm::vec4>(),
                changed};
    }

    GpuTexture before, now, products;
};

/// The timer and the frame's uniform block that passes run with.
struct Stage {
    explicit Stage(const RandomFrame& frame, bool historyValid = true)
        : block("frame", sizeof(gpu::FrameUniforms)) {
        gpu::FrameUniforms uniforms{};
        uniforms.size = frame.size;
        uniforms.strata = frame.strata;
        uniforms.frame = 7;
        uniforms.historyValid = historyValid ? 1 : 0;
        uniforms.signalClamp = 64.0f;
        uniforms.extent = 40.0f;
        block.write(std::array{uniforms});
    }

    GpuBuffer block;
    GpuTimer timer{true};
    FrameContext context{.timer = timer, .uniforms = &block};
};

} // namespace

Image<glm::vec4> runAtrous(ShaderLibrary& shaders, const RandomFrame& frame, Kernel kernel,
                           const gpu::EdgeStopping& params) {
    Stage stage(frame);
    const GpuTexture signal = upload("signal", frame.signal);
    const GpuTexture guides = upload("guides", frame.guides);
    const GpuTexture slope = upload("slope", frame.slope);
    GpuTexture filtered = output<glm::vec4>("filtered", frame.size);
    AtrousPass(shaders, kernel).run(stage.context, {signal, guides, slope}, {filtered}, params);
    return filtered.read<glm::vec4>();
}

Image<glm::vec4> luminanceRanges(const RandomFrame& frame) {
    const Image<glm::dvec4> exact =
        reference::luminanceRange(frame.raw, frame.guides, {0.3f, 0.7f, 0.0f, 0.0f});
    Image<glm::vec4> ranges(exact.size());
    for (std::size_t i = 0; i < ranges.pixels().size(); ++i) {
        const glm::dvec4& range = exact.pixels()[i];
        ranges.pixels()[i] =
            range.z == 0.0 ? glm::vec4(50.0f, 70.0f, 0.0f, 0.0f) : glm::vec4(range);
    }
    return ranges;
}

TemporalImages runTemporal(ShaderLibrary& shaders, const RandomFrame& frame, bool historyValid,
                           const gpu::TemporalParams& params, TemporalFindings* findings) {
    Stage stage(frame, historyValid);
    const GpuTexture raw = upload("raw", frame.raw);
    const GpuTexture visibility = upload("visibility", frame.visibility);
    const GpuTexture previousVisibility = upload("previous visibility", frame.previousVisibility);
    const GpuTexture guides = upload("guides", frame.guides);
    const GpuTexture previousGuides = upload("previous guides", frame.previousGuides);
    const GpuTexture slope = upload("slope", frame.slope);
    const GpuTexture motion = upload("motion", frame.motion);
    const GpuTexture previousColor = upload("previous color", frame.previousColor);
    const GpuTexture previousMoments = upload("previous moments", frame.previousMoments);
    const GpuTexture lambda = upload("lambda", frame.lambda);
    const GpuTexture luminanceRange = upload("luminance range", luminanceRanges(frame));
    const GpuTexture change = upload("change", frame.change);
    const GpuTexture changed =
        upload("changed", Image<std::uint32_t>(glm::ivec2(1), frame.changed));
    const GpuTexture samples = upload("samples", frame.samples);
    GpuTexture accumulated = output<glm::vec4>("accumulated", frame.size);
    GpuTexture moments = output<glm::vec4>("moments", frame.size);
    GpuTexture control = output<glm::vec4>("control", frame.size);
    const TemporalPass::Inputs in{.raw = raw,
                                  .visibility = visibility,
                                  .previousVisibility = previousVisibility,
                                  .guides = guides,
                                  .previousGuides = previousGuides,
                                  .slope = slope,
                                  .motion = motion,
                                  .previousColor = previousColor,
                                  .previousMoments = previousMoments,
                                  .lambda = lambda,
                                  .luminanceRange = luminanceRange,
                                  .change = change,
                                  .changed = changed,
                                  .samples = samples};
    TemporalPass pass(shaders);
    pass.run(stage.context, in, {accumulated, moments, control}, params);
    if (findings) {
        PixelReadback readback;
        std::vector<TemporalPass::Findings::Region> regions;
        for (int y = 0; y < frame.size.y; ++y)
            for (int x = 0; x < frame.size.x; ++x)
                regions.push_back(pass.inspect(stage.context, in, params, {x, y}, readback));
        readback.finish();
        for (const auto& region : regions)
            findings->push_back(readback.pixel(region));
    }
    return {accumulated.read<glm::vec4>(), moments.read<glm::vec4>(), control.read<glm::vec4>()};
}

Image<glm::vec4> runLuminanceRange(ShaderLibrary& shaders, const RandomFrame& frame,
                                   const gpu::PercentileParams& params) {
    Stage stage(frame);
    const GpuTexture raw = upload("raw", frame.raw);
    const GpuTexture guides = upload("guides", frame.guides);
    GpuTexture range = output<glm::vec4>("luminance range", luminanceRanges(frame).size());
    LuminanceRangePass(shaders).run(stage.context, {raw, guides}, {range}, params);
    return range.read<glm::vec4>();
}

Image<glm::vec4> runVariance(ShaderLibrary& shaders, const RandomFrame& frame,
                             const gpu::VarianceParams& params) {
    Stage stage(frame);
    const GpuTexture accumulated = upload("accumulated", frame.accumulated);
    const GpuTexture moments = upload("moments", frame.moments);
    const GpuTexture guides = upload("guides", frame.guides);
    const GpuTexture slope = upload("slope", frame.slope);
    GpuTexture filtered = output<glm::vec4>("filtered", frame.size);
    VariancePass(shaders).run(stage.context, {accumulated, moments, guides, slope}, {filtered},
                              params);
    return filtered.read<glm::vec4>();
}

Image<glm::vec4> runGradient(ShaderLibrary& shaders, const RandomFrame& frame,
                             const gpu::GradientParams& params) {
    Stage stage(frame);
    const GpuTexture raw = upload("raw", frame.raw);
    const GpuTexture previousRaw = upload("previous raw", frame.previousRaw);
    const GpuTexture samples = upload("samples", frame.samples);
    const GpuTexture guides = upload("guides", frame.guides);
    GpuTexture gradient = output<glm::vec4>("gradient", frame.strata);
    GradientPass(shaders).run(stage.context, {raw, previousRaw, samples, guides}, {gradient},
                              params);
    return gradient.read<glm::vec4>();
}

StrataImages runStrata(ShaderLibrary& shaders, const RandomFrame& frame) {
    Stage stage(frame);
    const GpuTexture guides = upload("guides", frame.guides);
    const GpuTexture slope = upload("slope", frame.slope);
    GpuTexture strataGuides = output<glm::vec4>("strata guides", frame.strata);
    GpuTexture strataSlope = output<glm::vec2>("strata slope", frame.strata);
    StrataPass(shaders).run(stage.context, {guides, slope}, {strataGuides, strataSlope});
    return {strataGuides.read<glm::vec4>(), strataSlope.read<glm::vec2>()};
}

Image<glm::vec4> runGradientAtrous(ShaderLibrary& shaders, const RandomFrame& frame, Kernel kernel,
                                   const gpu::EdgeStopping& params) {
    Stage stage(frame);
    const GpuTexture gradient = upload("gradient", frame.gradient);
    const GpuTexture guides = upload("strata guides", frame.strataGuides);
    const GpuTexture slope = upload("strata slope", frame.strataSlope);
    GpuTexture filtered = output<glm::vec4>("filtered gradient", frame.strata);
    GradientAtrousPass(shaders, kernel)
        .run(stage.context, {gradient, guides, slope}, {filtered}, params);
    return filtered.read<glm::vec4>();
}

Image<float> runLambda(ShaderLibrary& shaders, const RandomFrame& frame,
                       const gpu::GradientParams& params) {
    Stage stage(frame);
    const GpuTexture gradient = upload("gradient", frame.gradient);
    GpuTexture lambda = output<float>("lambda", frame.strata);
    LambdaPass(shaders).run(stage.context, {gradient}, {lambda}, params);
    return lambda.read<float>();
}

LightPairImages runLightPairs(ShaderLibrary& shaders, const RandomFrame& frame,
                              const Image<glm::vec4>* sampleRaw) {
    Stage stage(frame);
    const GpuTexture raw = upload("raw", frame.raw);
    const GpuTexture previousRaw = upload("previous raw", frame.previousRaw);
    const GpuTexture samples = upload("samples", frame.samples);
    const GpuTexture guides = upload("guides", frame.guides);
    std::optional<GpuTexture> beside;
    if (sampleRaw)
        beside.emplace(upload("sample raw", *sampleRaw));
    LightPairTextures out(frame.strata);
    GpuTexture changed = upload("changed", Image<std::uint32_t>(glm::ivec2(1), 1234u));
    LightPairsPass(shaders).run(stage.context,
                                {raw, previousRaw, samples, guides, beside ? &*beside : nullptr},
                                {out.pairs(), changed});
    return out.read(changed.read<std::uint32_t>()(glm::ivec2(0)));
}

LightPairImages runLightPairsAtrous(ShaderLibrary& shaders, const RandomFrame& frame, Kernel kernel,
                                    const gpu::EdgeStopping& params) {
    Stage stage(frame);
    LightPairTextures in(frame), out(frame.strata);
    const GpuTexture guides = upload("strata guides", frame.strataGuides);
    const GpuTexture slope = upload("strata slope", frame.strataSlope);
    LightPairsAtrousPass(shaders).run(stage.context, {in.pairs(), guides, slope}, {out.pairs()},
                                      kernel, params);
    return out.read();
}

ChangeOfLight runChange(ShaderLibrary& shaders, const RandomFrame& frame,
                        const gpu::ChangeParams& params) {
    Stage stage(frame);
    LightPairTextures in(frame);
    GpuTexture lambda = output<float>("lambda", frame.strata);
    GpuTexture change = output<glm::vec4>("change", frame.strata);
    ChangePass(shaders).run(stage.context, {in.pairs()}, {lambda, change}, params);
    return {lambda.read<float>(), change.read<glm::vec4>()};
}

} // namespace afterglow::test
