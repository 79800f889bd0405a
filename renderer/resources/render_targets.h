// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/framebuffer.h"
#include "renderer/resources/image_set.h"
#include "renderer/resources/path_targets.h"
#include "renderer/resources/ray_list.h"
#include "renderer/resources/surfaces.h"

#include <array>
#include <cstddef>
#include <vector>

namespace afterglow {

/// The number of filters that can run on the same signals, each with its own histories.
inline constexpr std::size_t kFilterStates = 4;
/// The largest number of signals of a frame.
inline constexpr std::size_t kMaxSignals = 2;

/// One signal of a frame: a part of the light, of one sample a pixel.
struct SignalTargets {
    SignalTargets() = default;
    explicit SignalTargets(glm::ivec2 size);

    std::vector<const GpuTexture*> all() const;
    void makeSums(); ///< those of a reference, zero

    History raw;
    GpuTexture sampleRaw; ///< RGBA32F, strata: of samples beside the picture; empty without any
    GpuTexture motion;    ///< RGBA32F: of what is mirrored; empty: it moves with its surface
    GpuTexture divisor;   ///< RGBA32F: what it is multiplied with in the end; empty: by the albedo
    // Of a reference; empty before the first one.
    GpuTexture sum;       ///< RGBA32F: of its samples
    GpuTexture lost;      ///< RGBA32F: what rounding has taken from the sum
    GpuTexture converged; ///< RGBA32F: mean signal, variance of one sample's luminance
};

/// The images of one filter state.
struct FilterTargets {
    FilterTargets() = default;
    explicit FilterTargets(glm::ivec2 size);

    bool empty() const { return composed.size().x == 0; }
    std::vector<const GpuTexture*> all() const;
    void makeResolved(); ///< that of anti-aliasing, without frames, unless there is one

    std::vector<ImageSet> own; ///< by signal: what the filter declares
    GpuTexture composed;       ///< RGBA32F: remodulated linear radiance
    GpuTexture display;        ///< RGBA8: tone-mapped, sRGB-encoded
    // Of anti-aliasing; empty without it.
    History resolved; ///< RGBA32F: rgb: average over time; a: frames in it
    GpuTexture toned; ///< RGBA32F: tone-mapped, linear, where that comes first
};

/// Every screen-sized texture of the renderer: what it holds, how, and for how long. Contents are
/// specified in docs/pipeline.md. Resize by assignment; nothing survives a resize.
struct RenderTargets {
    RenderTargets() = default;
    explicit RenderTargets(glm::ivec2 size);

    void swapHistories(); ///< current becomes previous, of all that are not empty; once a frame
    /// Makes so many signals; further ones begin with zeros.
    void setSignals(std::size_t count);
    void makeExposure(); ///< none, unless there is one
    /// Makes the images of paths, or releases them where none are traced. With `mirrors`, the last
    /// signal has a motion of its own.
    void setPaths(bool traced, bool mirrors);
    /// Returns the images that the next frame reads, without the histories of filters
    /// and of what is shown.
    std::vector<GpuTexture*> kept();
    std::vector<const GpuTexture*> all() const;
    std::size_t bytes() const;

    glm::ivec2 size{0}, strata{0};

    GpuTexture ids;   ///< RG32UI: instance + 1, triangle, as rasterized; 0 is background
    GpuTexture depth; ///< of the raster pass, reversed
    Framebuffer framebuffer;

    Surfaces surfaces;                             ///< of this frame
    GpuTexture previousVisibility, previousGuides; ///< of the frame before
    History seeds;
    std::vector<SignalTargets> signals;
    RayList rays;      ///< of the kind that is traced
    PathTargets paths; ///< empty before the first path

    GpuTexture owners;  ///< R32UI, strata: keys of forward projection
    GpuTexture claims;  ///< RG32UI, strata: what became of the samples before they were merged
    GpuTexture samples; ///< RGBA32UI, strata
    GpuTexture strataGuides, strataSlope;
    // Samples that are shaded beside the picture, one texel a stratum; empty before the first.
    Surfaces sampleSurfaces;
    GpuTexture sampleSeeds;

    Surfaces placed; ///< those of the picture at another moment; empty before they are first needed

    /// The first one always; the others are empty until they first run.
    std::array<FilterTargets, kFilterStates> filters;

    // Of the automatic exposure; empty without it.
    GpuTexture luminanceSums; ///< RGBA32F, tiles: sum of log2 of luminance, foreground pixels
    History
        exposure; ///< RGBA32F, one texel: stops, mean of log2 of luminance, foreground pixels, 1

    GpuTexture counters; ///< R32UI: shared/counters.h
};

/// Bytes that images take a pixel.
struct ImageBytes {
    double frame;  ///< whatever signals and filters there are
    double signal; ///< each
    double filter; ///< each, of each signal
    double paths;  ///< where they are traced, as two signals
};
ImageBytes imageBytes(std::span<const ImageDecl> filter);

} // namespace afterglow
