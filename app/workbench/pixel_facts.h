// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/readback.h"
#include "renderer/passes/gradient_pass.h"
#include "renderer/passes/temporal_pass.h"
#include "renderer/pipeline/aov.h"

#include <algorithm>
#include <map>
#include <optional>
#include <variant>

namespace afterglow {

/// The gradient sample of a stratum.
struct CarriedSample {
    glm::ivec2 landing{0}; ///< pixel of this frame
    glm::ivec2 source{0};  ///< pixel of the frame before
};

/// A random number's origin: which pixel of the blue-noise tile, in which frame (modulo 2^18).
struct PixelSeed {
    glm::ivec2 tile{0};
    std::uint32_t frame = 0;
};

/// What the last frame holds at one pixel and its stratum, in one filter.
struct PixelFacts {
    SvgfPlan plan;
    bool samplesBeside = false; ///< gradient samples are not in the picture
    glm::ivec2 pixel{0}, stratum{0};

    std::uint32_t instance = 0; ///< from 1; 0: there is no surface
    std::uint32_t triangle = 0;
    glm::vec2 barycentrics{0.0f};
    float rawLuminance = 0.0f;
    PixelSeed seed;
    /// The AOVs that the filter makes, by name: a number for each channel.
    std::map<std::string_view, std::vector<double>> images;

    // Where samples are carried.
    std::optional<CarriedSample> sample;
    std::uint32_t fate = gpu::kFateNone;           ///< of the one that this stratum offered
    glm::ivec2 offeredTo{0};                       ///< the stratum where that landed, if it did
    std::optional<gpu::GradientFindings> gradient; ///< where they have been shaded

    std::optional<gpu::TemporalFindings> temporal; ///< where the filter accumulates

    bool isSurface() const { return instance != 0; }
    bool isSample() const { return sample && sample->landing == pixel; }
    double image(std::string_view aov) const { return images.at(aov).at(0); }
    int reason() const { return int(temporal->control.w); } ///< gpu::kHistory...
    bool hasHistory() const { return temporal->fetchedSamples > 0.0f; }
    /// Returns whether the filter looked for a history in the frame before.
    bool hasTaps() const {
        return std::ranges::any_of(temporal->taps, [](auto& tap) { return tap.weight > 0.0f; });
    }
};

/// Asks for what a frame holds at one pixel, and is answered once a readback has finished.
class PixelQuery {
public:
    explicit PixelQuery(ShaderLibrary& shaders) : gradient_(shaders), temporal_(shaders) {}

    /// Asks for a pixel of the last frame. One outside the picture, or a state that did not run in
    /// that frame, is std::logic_error.
    void ask(Renderer& renderer, std::size_t state, glm::ivec2 pixel, std::size_t signal,
             PixelReadback& readback);
    PixelFacts answer(const PixelReadback& readback) const; ///< of the last ask()

private:
    template <class Pixel>
    using Region = PixelReadback::Region<Pixel>;
    /// A texel of an AOV.
    struct Texel {
        const AovInfo* aov;
        int channel;
        bool isFloatBits;
        std::variant<Region<float>, Region<glm::vec2>, Region<glm::vec4>, Region<glm::uvec4>> at;
    };
    /// The places of what was asked in the readback; empty where the filter does not make it.
    struct Regions {
        Region<glm::uvec4> visibility, sample;
        Region<glm::vec4> raw;
        Region<std::uint32_t> seed;
        std::vector<Texel> images;
        std::optional<GradientPass::Findings::Region> gradient;
        std::optional<TemporalPass::Findings::Region> temporal;
    };
    static Texel texelOf(const AovInfo& aov, const AovSource& source, glm::ivec2 texel,
                         PixelReadback& readback);

    GradientPass gradient_;
    TemporalPass temporal_;
    PixelFacts known_; ///< what needs no answer
    Regions at_;
};

} // namespace afterglow
