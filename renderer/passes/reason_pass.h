// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/readback.h"
#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"
#include "shared/instrument_params.h"

#include <array>
#include <cstdint>

namespace afterglow {

/// How many there are of each code; the last number of each array also counts the codes above.
struct ReasonCounts {
    std::array<std::uint32_t, gpu::kHistoryBins> history{}; ///< foreground pixels, by kHistory...
    std::array<std::uint32_t, gpu::kFateBins> fates{};      ///< strata, by kFate...
};

/// Counts the reasons of pixels and the fates of gradient samples. See shaders/post/reasons.comp.
class ReasonPass {
public:
    struct Inputs {
        const GpuTexture& control;           ///< RGBA32F; w: reason
        const GpuTexture& guides;            ///< w: depth; 0: background
        const GpuTexture* samples = nullptr; ///< RGBA32UI, strata; w: fate; empty: none are counted
    };

    explicit ReasonPass(ShaderLibrary& shaders);
    /// Control and guides of different sizes are std::logic_error.
    void run(FrameContext& frame, const Inputs& in);

    /// Copies the counts of the last run into a readback; 0 before the first run.
    using Region = PixelReadback::Region<std::uint32_t>;
    Region copyTo(PixelReadback& readback) const;
    static ReasonCounts countsOf(const PixelReadback& readback, const Region& region);

    /// Of the last run, which it waits for; all 0 before the first.
    ReasonCounts read() const;

private:
    ShaderLibrary& shaders_;
    GpuTexture counts_;
};

} // namespace afterglow
