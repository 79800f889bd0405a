// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"
#include "shared/denoise_params.h"
#include "shared/instrument_params.h"
#include "tests/support/random_frame.h"

namespace afterglow::test {

// Each function constructs the real pass, fills its inputs from the frame, runs it and reads back.
// Outputs hold garbage before, so a pixel that is not written shows.

/// Sizes at which whole workgroups, partial ones, partial strata and single pixels occur.
constexpr glm::ivec2 kStageSizes[] = {{61, 37}, {1, 1}, {2, 5}, {8, 8}, {16, 9}, {130, 3}};

Image<glm::vec4> runAtrous(ShaderLibrary& shaders, const RandomFrame& frame, Kernel kernel,
                           const gpu::EdgeStopping& params);

struct TemporalImages {
    Image<glm::vec4> accumulated, moments, control;
};
using TemporalFindings = std::vector<gpu::TemporalFindings>; ///< of all pixels, row by row
/// Ranges for runTemporal(), about as wide as the noise of the frame; garbage in tiles that show
/// background alone.
Image<glm::vec4> luminanceRanges(const RandomFrame& frame);

TemporalImages runTemporal(ShaderLibrary& shaders, const RandomFrame& frame, bool historyValid,
                           const gpu::TemporalParams& params, TemporalFindings* findings = nullptr);

Image<glm::vec4> runLuminanceRange(ShaderLibrary& shaders, const RandomFrame& frame,
                                   const gpu::PercentileParams& params);

Image<glm::vec4> runVariance(ShaderLibrary& shaders, const RandomFrame& frame,
                             const gpu::VarianceParams& params);

Image<glm::vec4> runGradient(ShaderLibrary& shaders, const RandomFrame& frame,
                             const gpu::GradientParams& params);

struct StrataImages {
    Image<glm::vec4> guides;
    Image<glm::vec2> slope;
};
StrataImages runStrata(ShaderLibrary& shaders, const RandomFrame& frame);

Image<glm::vec4> runGradientAtrous(ShaderLibrary& shaders, const RandomFrame& frame, Kernel kernel,
                                   const gpu::EdgeStopping& params);

Image<float> runLambda(ShaderLibrary& shaders, const RandomFrame& frame,
                       const gpu::GradientParams& params);

struct LightPairImages {
    Image<glm::vec4> before, now, products;
    std::uint32_t changed = 0; ///< strata
};
/// `sampleRaw`, one texel a stratum: light of samples beside the picture.
LightPairImages runLightPairs(ShaderLibrary& shaders, const RandomFrame& frame,
                              const Image<glm::vec4>* sampleRaw = nullptr);

LightPairImages runLightPairsAtrous(ShaderLibrary& shaders, const RandomFrame& frame, Kernel kernel,
                                    const gpu::EdgeStopping& params);

struct ChangeOfLight {
    Image<float> lambda;
    Image<glm::vec4> change;
};
ChangeOfLight runChange(ShaderLibrary& shaders, const RandomFrame& frame,
                        const gpu::ChangeParams& params);

} // namespace afterglow::test
