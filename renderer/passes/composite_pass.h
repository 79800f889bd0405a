// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"

#include <span>

namespace afterglow {

/// Emission plus the sum of all signals, each times what it was divided by: linear radiance. See
/// shaders/post/composite.comp. Reads the frame block.
class CompositePass {
public:
    struct Term {
        const GpuTexture& signal;
        const GpuTexture& demodulation;
    };
    struct Inputs {
        std::span<const Term> terms; ///< 1 to kMaxSignals; another number is std::logic_error
        const GpuTexture& emission;
        const GpuTexture& guides;
    };
    struct Outputs {
        GpuTexture& composed;
    };

    explicit CompositePass(ShaderLibrary& shaders);
    void run(FrameContext& frame, const Inputs& in, const Outputs& out);

private:
    ShaderLibrary& shaders_;
};

} // namespace afterglow
