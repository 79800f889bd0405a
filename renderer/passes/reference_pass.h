// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"
#include "shared/post_params.h"

namespace afterglow {

/// A running sum of raw signals, and its mean: the converged reference. See
/// shaders/lighting/accumulate.comp and mean.comp. Reads the frame block.
class ReferencePass {
public:
    struct Sums {
        GpuTexture& sum;  ///< RGBA32F: rgb of the signal, square of its luminance
        GpuTexture& lost; ///< RGBA32F: what rounding has taken from it
    };

    explicit ReferencePass(ShaderLibrary& shaders);
    /// `seeds`, where they are given, become those of the next sample.
    void add(FrameContext& frame, const GpuTexture& raw, const Sums& to, GpuTexture* seeds);
    /// rgb: mean signal; a: variance of one sample's luminance.
    void mean(FrameContext& frame, const GpuTexture& sum, int samples, GpuTexture& mean);

private:
    ComputeProgram& accumulate_;
    ComputeProgram& accumulateLast_;
    ComputeProgram& mean_;
};

} // namespace afterglow
