// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"
#include "shared/denoise_params.h"

namespace afterglow {

/// Two percentiles of the raw luminance of each tile of 8x8 pixels, against which a history can be
/// held. See shaders/denoise/luminance_range.comp and docs/pipeline.md.
class LuminanceRangePass {
public:
    struct Inputs {
        const GpuTexture& raw;
        const GpuTexture& guides;
    };
    struct Outputs {
        GpuTexture& luminanceRange; ///< per tile: low, high, foreground pixels, 0
    };

    explicit LuminanceRangePass(ShaderLibrary& shaders);
    void run(FrameContext& frame, const Inputs& in, const Outputs& out,
             const gpu::PercentileParams& params);

private:
    ComputeProgram& program_;
};

} // namespace afterglow
