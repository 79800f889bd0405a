// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/filters/aov_info.h"
#include "renderer/filters/filter_settings.h"
#include "renderer/gl/shader_library.h"
#include "renderer/resources/render_targets.h"

#include <memory>
#include <span>
#include <string_view>

namespace afterglow {

/// The work that a frame does for a filter before it runs.
struct FilterNeeds {
    bool samples = false; ///< some of the last frame's samples, shaded again with their seeds
    bool lambda = false;  ///< the guides of strata, and those samples shaded where they are beside
                          ///< the picture
};

/// The inputs of a filter: a frame's G-buffer and one of its signals.
struct FilterInput {
    const Surfaces& surfaces;
    const GpuTexture &previousVisibility, &previousGuides;
    const GpuTexture& motion; ///< of the signal: of the surfaces, or of what they mirror
    const GpuTexture &samples, &strataGuides, &strataSlope; ///< as FilterNeeds asks for them
    const SignalTargets& signal; ///< the noise, of which gradients are taken
    const GpuTexture& newest;    ///< what is filtered: the signal, or what a filter made of it.
                                 ///< RGBA32F: rgb, luminance
    bool samplesBeside = false;  ///< gradient samples are in signal.sampleRaw, not in the picture
};

/// The part of an ImageSet that one filter has declared: where filters are composed, each has its
/// own.
class FilterImages {
public:
    explicit FilterImages(ImageSet& set, std::size_t first = 0) : set_(set), first_(first) {}

    GpuTexture& operator[](std::size_t image) { return set_[first_ + image]; }
    const GpuTexture& previous(std::size_t image) const { return set_.previous(first_ + image); }
    FilterImages from(std::size_t image) const { return FilterImages(set_, first_ + image); }

private:
    ImageSet& set_;
    std::size_t first_;
};

/// The programs of a filter. It has no memory of its own: its images are in the RenderTargets, one
/// set for each state and signal.
class SignalFilter {
public:
    virtual ~SignalFilter() = default;

    /// Filters one signal of a frame; returns the texture with the result, RGBA32F: rgb the signal,
    /// a the variance of its luminance where the filter estimates one.
    virtual const GpuTexture& run(FrameContext& frame, const FilterInput& in,
                                  const FilterSettings& settings, FilterImages own) = 0;
};

/// An image of a filter that can be looked at.
struct FilterAov {
    AovInfo info;
    bool (*isMade)(const FilterSettings& settings);
    /// Its place among the declared images; kFilterResult is what run() returns.
    std::size_t (*image)(const FilterSettings& settings);
    int channel = 0; ///< its first one in that image
};
inline constexpr std::size_t kFilterResult = ~std::size_t(0);

/// The images, AOVs and programs that several filters share. A state keeps its histories when it
/// changes to another filter of the same family.
struct FilterFamily {
    std::span<const ImageDecl> images;
    std::span<const FilterAov> aovs;
    FilterNeeds (*needs)(const FilterSettings& settings);
    std::unique_ptr<SignalFilter> (*make)(ShaderLibrary& shaders);
};

} // namespace afterglow
