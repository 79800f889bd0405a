// SPDX-License-Identifier: MIT
#include "renderer/resources/render_targets.h"

#include "shared/counters.h"

namespace afterglow {
namespace {

GpuTexture cleared(std::string_view label, PixelFormat format, glm::ivec2 size) {
    GpuTexture texture(label, format, size);
    texture.clear();
    return texture;
}

void append(std::vector<const GpuTexture*>& list, const std::vector<const GpuTexture*>& more) {
    list.insert(list.end(), more.begin(), more.end());
}

std::vector<const GpuTexture*> madeOf(std::initializer_list<const GpuTexture*> textures) {
    std::vector<const GpuTexture*> made;
    for (const GpuTexture* texture : textures)
        if (texture->size().x != 0)
            made.push_back(texture);
    return made;
}

} // namespace

SignalTargets::SignalTargets(glm::ivec2 size) : raw("raw", PixelFormat::RGBA32F, size) {
    raw.clear();
}

void SignalTargets::makeSums() {
    const glm::ivec2 size = raw.current().size();
    if (sum.size() != size) {
        sum = GpuTexture("sum", PixelFormat::RGBA32F, size);
        lost = GpuTexture("sum, lost", PixelFormat::RGBA32F, size);
        converged = cleared("converged", PixelFormat::RGBA32F, size);
    }
    sum.clear();
    lost.clear();
}

std::vector<const GpuTexture*> SignalTargets::all() const {
    return madeOf(
        {&raw.current(), &raw.previous(), &sampleRaw, &motion, &divisor, &sum, &lost, &converged});
}

FilterTargets::FilterTargets(glm::ivec2 size)
    : composed(cleared("composed", PixelFormat::RGBA32F, size)),
      display(cleared("display", PixelFormat::RGBA8, size)) {}

std::vector<const GpuTexture*> FilterTargets::all() const {
    std::vector<const GpuTexture*> textures =
        madeOf({&composed, &display, &resolved.current(), &resolved.previous(), &toned});
    for (const ImageSet& images : own)
        append(textures, images.all());
    return textures;
}

void FilterTargets::makeResolved() {
    if (resolved.current().size().x != 0)
        return;
    resolved = History("resolved", PixelFormat::RGBA32F, composed.size());
    resolved.clear();
}

RenderTargets::RenderTargets(glm::ivec2 imageSize)
    : size(imageSize), strata(strataOf(imageSize)), ids(cleared("ids", PixelFormat::RG32UI, size)),
      depth(cleared("depth", PixelFormat::Depth32F, size)), surfaces(size),
      previousVisibility(cleared("visibility (previous)", PixelFormat::RGBA32UI, size)),
      previousGuides(cleared("guides (previous)", PixelFormat::RGBA32F, size)),
      seeds("seeds", PixelFormat::R32UI, size), rays(size),
      owners(cleared("owners", PixelFormat::R32UI, strata)),
      claims(cleared("claims", PixelFormat::RG32UI, strata)),
      samples(cleared("samples", PixelFormat::RGBA32UI, strata)),
      strataGuides(cleared("strata guides", PixelFormat::RGBA32F, strata)),
      strataSlope(cleared("strata slope", PixelFormat::RG32F, strata)),
      counters(cleared("counters", PixelFormat::R32UI, {int(gpu::kCounterCount), 1})) {
    seeds.clear();
    setSignals(1);
    filters[0] = FilterTargets(size);
    framebuffer = Framebuffer("visibility", {&ids}, &depth);
}

void RenderTargets::setSignals(std::size_t count) {
    while (signals.size() > count)
        signals.pop_back();
    while (signals.size() < count)
        signals.emplace_back(size);
    for (FilterTargets& filter : filters)
        if (filter.own.size() > count)
            filter.own.resize(count);
}

void RenderTargets::setPaths(bool traced, bool mirrors) {
    const auto set = [&](GpuTexture& image, const char* label, bool wanted) {
        if (!wanted)
            image = {};
        else if (image.size() != size)
            image = GpuTexture(label, PixelFormat::RGBA32F, size);
    };
    if (traced == paths.empty())
        paths = traced ? PathTargets(size) : PathTargets();
    for (SignalTargets& signal : signals) {
        set(signal.divisor, "divisor", traced);
        set(signal.motion, "reflected motion", mirrors && &signal == &signals.back());
    }
}

void RenderTargets::swapHistories() {
    std::swap(surfaces.visibility, previousVisibility);
    std::swap(surfaces.guides, previousGuides);
    seeds.swap();
    for (SignalTargets& signal : signals)
        signal.raw.swap();
    exposure.swap();
    for (FilterTargets& filter : filters) {
        filter.resolved.swap();
        for (ImageSet& images : filter.own)
            images.swapHistories();
    }
}

void RenderTargets::makeExposure() {
    if (exposure.current().size().x != 0)
        return;
    exposure = History("exposure", PixelFormat::RGBA32F, glm::ivec2(1));
    exposure.clear();
}

std::vector<GpuTexture*> RenderTargets::kept() {
    std::vector<GpuTexture*> images{&surfaces.visibility, &surfaces.guides, &seeds.current()};
    for (SignalTargets& signal : signals)
        images.push_back(&signal.raw.current());
    return images;
}

std::vector<const GpuTexture*> RenderTargets::all() const {
    std::vector<const GpuTexture*> textures = madeOf(
        {&ids, &depth, &previousVisibility, &previousGuides, &seeds.current(), &seeds.previous(),
         &owners, &claims, &samples, &strataGuides, &strataSlope, &sampleSeeds, &luminanceSums,
         &exposure.current(), &exposure.previous(), &counters});
    for (const Surfaces* seen : {&surfaces, &sampleSurfaces, &placed})
        if (!seen->empty())
            append(textures, seen->all());
    for (const SignalTargets& signal : signals)
        append(textures, signal.all());
    append(textures, paths.all());
    for (const FilterTargets& filter : filters)
        append(textures, filter.all());
    return textures;
}

std::size_t RenderTargets::bytes() const {
    std::size_t sumOfBytes = rays.bytes() + paths.bufferBytes();
    for (const GpuTexture* texture : all())
        sumOfBytes += texture->bytes();
    return sumOfBytes;
}

ImageBytes imageBytes(std::span<const ImageDecl> filter) {
    // Whole strata, tiles and segments: what a small picture takes is what a large one takes.
    static constexpr glm::ivec2 kSmall{48, 48};
    const auto perPixel = [](std::size_t bytes) {
        return double(bytes) / double(kSmall.x * kSmall.y);
    };
    RenderTargets targets(kSmall);
    const std::size_t one = targets.bytes();
    targets.setSignals(2);
    const std::size_t signal = targets.bytes() - one;
    targets.setPaths(true, true);
    const std::size_t paths = targets.bytes() - one - signal;
    const FilterTargets shown = FilterTargets(kSmall);
    std::size_t picture = 0;
    for (const GpuTexture* texture : shown.all())
        picture += texture->bytes();
    return {.frame = perPixel(one - signal - picture),
            .signal = perPixel(signal),
            .filter = perPixel(bytesOf(filter, kSmall) + picture),
            .paths = perPixel(paths)};
}

} // namespace afterglow
