#pragma once

#include "renderer/gl/readback.h"
#include "renderer/passes/history_taps_pass.h"
#include "renderer/pipeline/renderer.h"

#include <array>
#include <optional>

namespace afterglow {

/// One of the four pixels of the frame before that a history is interpolated between.
struct HistoryTap {
    glm::ivec2 pixel{0};
    float weight = 0.0f;            ///< bilinear; the four sum to 1
    int reason = gpu::kHistoryNone; ///< gpu::kHistory...
};

/// What the temporal pass fetched at a pixel. No image keeps it: it is found again from the images
/// that the pass read. docs/pipeline.md, "Temporal accumulation".
struct FetchedHistory {
    glm::vec2 position{0.0f}; ///< in the frame before, pixels, their centers at integers
    std::array<HistoryTap, 4> taps;
    float length = 0.0f; ///< N as fetched, frames; 0: none

    int validTaps() const; ///< of those that weigh anything
    int usedTaps() const;  ///< that weigh anything
};

/// The gradient sample of a stratum.
struct CarriedSample {
    glm::ivec2 landing{0};    ///< pixel of this frame
    glm::ivec2 source{0};     ///< pixel of the frame before
    float before = 0.0f;      ///< luminance there and then
    std::optional<float> now; ///< unless nobody has shaded it
};

/// What a stratum knows of the change of its light, where the filter asks.
struct StratumGradient {
    glm::vec2 measured{0.0f};      ///< delta, Delta of its sample; 0 without one
    glm::vec2 reconstructed{0.0f}; ///< with those around; as measured if there are no iterations
    float mean = 0.0f, variance = 0.0f; ///< of the raw luminance in the stratum
    float lambda = 0.0f;
};

/// A random number's origin: which pixel of the blue-noise tile, in which frame (modulo 2^18).
struct PixelSeed {
    glm::ivec2 tile{0};
    std::uint32_t frame = 0;
};

/// What the last frame holds at one pixel and its stratum, in one filter.
struct PixelFacts {
    FilterSettings settings;
    SvgfPlan plan;
    bool hasExtraSamples = false; ///< they are beside the picture
    glm::ivec2 pixel{0}, stratum{0};

    // The surface. Where there is none, `instance` is 0 and what is here has no meaning.
    std::uint32_t instance = 0; ///< from 1
    std::uint32_t triangle = 0;
    glm::vec2 barycentrics{0.0f};
    glm::vec3 position{0.0f}, normal{0.0f};
    float depth = 0.0f;
    glm::vec2 slope{0.0f};
    glm::vec4 motion{0.0f};
    glm::vec3 albedo{0.0f}, emission{0.0f};

    glm::vec4 raw{0.0f}; ///< a: luminance
    PixelSeed seed;

    // Where samples are carried.
    std::optional<CarriedSample> sample;
    std::uint32_t fate = gpu::kFateNone; ///< of the one that this stratum offered
    glm::ivec2 offeredTo{0};             ///< the stratum where that landed, if it did

    std::optional<StratumGradient> gradient; ///< where the filter uses it

    // Where the filter accumulates.
    int reason = gpu::kHistoryNone;
    float lambda = 0.0f, alpha = 0.0f;
    float length = 0.0f; ///< N', as left for the next frame
    float historyLuminance = 0.0f;
    glm::vec2 moments{0.0f};
    glm::vec4 accumulated{0.0f};
    std::optional<FetchedHistory> fetched; ///< where a frame before can be looked at
    std::optional<glm::ivec2> lambdaFrom;  ///< the stratum whose lambda it is, unless of several
    std::optional<glm::vec2> range;        ///< of the raw luminance, for lambda from percentiles

    glm::vec4 filtered{0.0f}; ///< a: variance
    glm::vec3 color{0.0f};

    bool isSurface() const { return instance != 0; }
    bool isSample() const { return sample && sample->landing == pixel; }
};

/// Asks what a frame holds at one pixel, and is answered once a readback has finished.
class PixelQuery {
public:
    explicit PixelQuery(ShaderLibrary& shaders) : past_(shaders) {}

    /// Of the last frame, whose settings are given. The pixel is inside the picture and the state
    /// ran in that frame; else std::logic_error.
    void ask(Renderer& renderer, std::size_t state, const FrameSettings& settings, glm::ivec2 pixel,
             std::size_t signal, PixelReadback& readback);
    PixelFacts answer(const PixelReadback& readback) const; ///< what was asked last

    /// The places of the pixels in the readback; empty for images that the filter does not make.
    struct Regions {
        template <class Pixel>
        using Region = PixelReadback::Region<Pixel>;

        Region<glm::uvec4> visibility, surface;
        Region<glm::vec4> guides, motion, albedo, emission, filtered, composed;
        Region<glm::vec2> slope;
        Region<glm::vec4> raw; ///< of the stratum's pixels
        Region<std::uint32_t> seed;
        Region<glm::uvec4> sample;
        Region<glm::vec4> extraRaw, gradientSample, gradient;
        Region<float> lambda; ///< of the stratum and those around
        Region<glm::vec4> control, moments, accumulated;
        Region<glm::vec4> luminanceRange; ///< of the four tiles around
        HistoryTapsPass::Region past;
    };

private:
    HistoryTapsPass past_;
    PixelFacts known_; ///< what needs no answer
    glm::ivec2 size_{0}, strata_{0};
    Regions at_;
};

} // namespace afterglow
