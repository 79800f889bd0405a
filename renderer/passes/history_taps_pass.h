#pragma once

#include "renderer/gl/readback.h"
#include "renderer/gl/shader_library.h"
#include "renderer/passes/frame_context.h"
#include "shared/instrument_params.h"

#include <array>

namespace afterglow {

/// Gathers the previous frame's values at the four taps of a pixel's history, and at the source of
/// its stratum's gradient sample. See shaders/post/history_taps.comp.
class HistoryTapsPass {
public:
    struct Inputs {
        const GpuTexture& motion;     ///< xy: to the position in the frame before, pixels
        const GpuTexture& samples;    ///< RGBA32UI, strata; z: source of the gradient sample
        const GpuTexture& visibility; ///< RGBA32UI, of the frame before, as all below
        const GpuTexture& guides;     ///< xyz: normal; w: depth
        const GpuTexture& moments;    ///< z: history length
        const GpuTexture& raw;        ///< rgb: signal of one sample; a: luminance
    };
    struct Tap {
        std::uint32_t instance = 0;
        glm::vec4 guides{0.0f}, moments{0.0f};
    };
    struct Past {
        /// In the order (0, 0), (1, 0), (0, 1), (1, 1). One outside the picture holds the pixel at
        /// the edge.
        std::array<Tap, 4> taps;
        glm::vec4 sampleRaw{0.0f}; ///< without meaning where the stratum has no sample
    };
    using Region = PixelReadback::Region<glm::uvec4>;

    explicit HistoryTapsPass(ShaderLibrary& shaders);

    /// Of a pixel of the picture; another one, or inputs of different sizes, are std::logic_error.
    void run(FrameContext& frame, const Inputs& in, glm::ivec2 pixel);

    Region copyTo(PixelReadback& readback) const; ///< of the last run
    static Past pastOf(const PixelReadback& readback, const Region& region);

private:
    ShaderLibrary& shaders_;
    GpuTexture taps_;
};

} // namespace afterglow
