#pragma once

#include "renderer/gl/framebuffer.h"
#include "renderer/resources/history.h"

#include <array>
#include <cstddef>
#include <vector>

namespace afterglow {

/// The number of strata that cover an image: ceil(size / 3).
glm::ivec2 strataOf(glm::ivec2 size);
/// The number of tiles that cover an image: ceil(size / 8).
glm::ivec2 tilesOf(glm::ivec2 size);

/// How many filters can run on one raw signal, each with its own histories.
inline constexpr std::size_t kFilterStates = 4;

/// What one filter makes of a frame and keeps of it. Contents are specified in docs/pipeline.md.
struct FilterTargets {
    FilterTargets() = default;
    explicit FilterTargets(glm::ivec2 size);

    bool empty() const { return size.x == 0; }
    std::vector<const GpuTexture*> all() const;

    glm::ivec2 size{0};
    History color, moments;
    GpuTexture gradientSamples; ///< RGBA32F, strata: as measured
    GpuTexture gradient[2]; ///< RGBA32F, strata: reconstructed in turns; the result is the first
    GpuTexture strataGuides, strataSlope, lambda;
    GpuTexture luminanceRange; ///< RGBA32F, tiles
    GpuTexture accumulated, control;
    GpuTexture filtered[2];
    GpuTexture composed; ///< RGBA32F: remodulated linear radiance
    GpuTexture display;  ///< RGBA8: tone-mapped, sRGB-encoded
};

/// Gradient samples that are shaded beside the picture: one texel a stratum.
struct ExtraSamples {
    ExtraSamples() = default;
    explicit ExtraSamples(glm::ivec2 strata);

    bool empty() const { return raw.size().x == 0; }
    std::vector<const GpuTexture*> all() const;

    GpuTexture visibility, seeds, surface, guides, slope, motion, albedo, emission, raw;
};

/// Every screen-sized texture of the renderer: what it holds, how, and for how long. Contents are
/// specified in docs/pipeline.md. Resize by assignment; nothing survives a resize.
struct RenderTargets {
    RenderTargets() = default;
    explicit RenderTargets(glm::ivec2 size);

    void swapHistories(); ///< current becomes previous, of all that are not empty; once a frame
    void clear();         ///< everything to zero
    std::size_t bytes() const;
    std::vector<const GpuTexture*> all() const;

    glm::ivec2 size{0}, strata{0};

    GpuTexture ids;   ///< RG32UI: instance + 1, triangle, as rasterized; 0 is background
    GpuTexture depth; ///< of the raster pass, reversed
    Framebuffer framebuffer;

    History visibility, seeds, guides, raw;
    GpuTexture surface, slope, motion, albedo, emission;

    GpuTexture owners;  ///< R32UI, strata: keys of forward projection
    GpuTexture claims;  ///< RG32UI, strata: what became of the samples before they were merged
    GpuTexture samples; ///< RGBA32UI, strata
    ExtraSamples extra; ///< empty until they are first asked for

    /// The first one always; the others are empty until they first run.
    std::array<FilterTargets, kFilterStates> filters;

    GpuTexture sum;      ///< RGBA32F: of reference samples
    GpuTexture counters; ///< R32UI: shared/counters.h
};

} // namespace afterglow
