// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"
#include "shared/denoise_params.h"

namespace afterglow {

/// One iteration of the edge-avoiding a-trous wavelet filter, guided by variance.
/// Schied et al. 2017, section 4.4. See shaders/denoise/atrous.comp and docs/pipeline.md.
class AtrousPass {
public:
    struct Inputs {
        const GpuTexture& signal; ///< rgb: demodulated signal; a: variance of its luminance
        const GpuTexture& guides; ///< xyz: world normal; w: depth, meters; 0 marks background
        const GpuTexture& slope;  ///< dz/dx, dz/dy: meters per pixel
    };
    struct Outputs {
        GpuTexture& filtered; ///< as Inputs::signal; never the same texture
    };

    AtrousPass(ShaderLibrary& shaders, Kernel kernel) : shaders_(shaders), kernel_(kernel) {}
    /// Compiles the program for these parameters, which run() does otherwise.
    void prepare(const gpu::EdgeStopping& params);
    /// A step that is no power of two is std::logic_error.
    void run(FrameContext& frame, const Inputs& in, const Outputs& out,
             const gpu::EdgeStopping& params);

private:
    ShaderLibrary& shaders_;
    Kernel kernel_;
};

} // namespace afterglow
