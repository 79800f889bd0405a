// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/readback.h"
#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"

#include <cstdint>
#include <optional>

namespace afterglow {

/// Means over the foreground pixels of a rectangle; all 0 where it has none.
struct ProbeReading {
    std::uint64_t pixels = 0;    ///< foreground ones
    double lit = 0.0;            ///< luminance of the filtered signal times albedo
    double rawLit = 0.0;         ///< luminance of the signal of one sample times albedo
    double rawVariance = 0.0;    ///< (population) variance, over the pixels, of raw's luminance
    double variance = 0.0;       ///< that the filter has estimated for its signal's luminance
    double lambda = 0.0;         ///< in [0, 1]
    double alpha = 0.0;          ///< weight of the newest frame
    double history = 0.0;        ///< length, in frames
    double rawLitVariance = 0.0; ///< as rawVariance, of the luminance whose mean is rawLit
};

/// What a rectangle of the picture holds. The same images give the same bits. See
/// shaders/post/probe.comp.
class ProbePass {
public:
    /// The second signal of the picture.
    struct OtherSignal {
        const GpuTexture &filtered, &raw, &demodulation;
    };
    struct Inputs {
        const GpuTexture& filtered; ///< RGBA32F: signal, variance
        const GpuTexture& raw;      ///< RGBA32F: signal of one sample, luminance
        const GpuTexture& albedo;
        const GpuTexture& guides;  ///< w: depth; 0: background
        const GpuTexture& control; ///< lambda, alpha, history length, reason
        std::optional<OtherSignal> other = {};
    };

    explicit ProbePass(ShaderLibrary& shaders);

    /// Of the pixels `min` to `min + size`; those outside the picture do not count. Inputs of
    /// different sizes are std::logic_error.
    void run(FrameContext& frame, const Inputs& in, glm::ivec2 min, glm::ivec2 size);

    /// Copies the sums of the last run into a readback; empty before the first run.
    using Region = PixelReadback::Region<glm::vec4>;
    Region copyTo(PixelReadback& readback) const;
    static ProbeReading readingOf(const PixelReadback& readback, const Region& region);

    /// Of the last run, which it waits for; all 0 before the first.
    ProbeReading read() const;

private:
    ShaderLibrary& shaders_;
    GpuTexture sums_;
    glm::ivec2 blocks_{0}; ///< that the last run has written
};

} // namespace afterglow
