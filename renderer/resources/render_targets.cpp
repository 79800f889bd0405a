#include "renderer/resources/render_targets.h"

#include "shared/bindings.h"
#include "shared/counters.h"

namespace afterglow {
namespace {

// What all() of an object that is being made or changed names are its own members.
void clearAll(const std::vector<const GpuTexture*>& textures) {
    for (const GpuTexture* texture : textures)
        const_cast<GpuTexture*>(texture)->clear();
}

} // namespace

glm::ivec2 strataOf(glm::ivec2 size) {
    return (size + int(gpu::kStratumSize) - 1) / int(gpu::kStratumSize);
}

glm::ivec2 tilesOf(glm::ivec2 size) {
    return (size + int(gpu::kTileSize) - 1) / int(gpu::kTileSize);
}

FilterTargets::FilterTargets(glm::ivec2 imageSize)
    : size(imageSize), color("color", PixelFormat::RGBA32F, size),
      moments("moments", PixelFormat::RGBA32F, size),
      gradientSamples("gradient samples", PixelFormat::RGBA32F, strataOf(size)),
      gradient{{"gradient 0", PixelFormat::RGBA32F, strataOf(size)},
               {"gradient 1", PixelFormat::RGBA32F, strataOf(size)}},
      strataGuides("strata guides", PixelFormat::RGBA32F, strataOf(size)),
      strataSlope("strata slope", PixelFormat::RG32F, strataOf(size)),
      lambda("lambda", PixelFormat::R32F, strataOf(size)),
      luminanceRange("luminance range", PixelFormat::RGBA32F, tilesOf(size)),
      accumulated("accumulated", PixelFormat::RGBA32F, size),
      control("control", PixelFormat::RGBA32F, size), filtered{{"filtered 0", PixelFormat::RGBA32F,
                                                                size},
                                                               {"filtered 1", PixelFormat::RGBA32F,
                                                                size}},
      composed("composed", PixelFormat::RGBA32F, size),
      display("display", PixelFormat::RGBA8, size) {
    clearAll(all());
}

std::vector<const GpuTexture*> FilterTargets::all() const {
    if (empty())
        return {};
    return {&color.current(), &color.previous(), &moments.current(), &moments.previous(),
            &gradientSamples, &gradient[0],      &gradient[1],       &strataGuides,
            &strataSlope,     &lambda,           &luminanceRange,    &accumulated,
            &control,         &filtered[0],      &filtered[1],       &composed,
            &display};
}

ExtraSamples::ExtraSamples(glm::ivec2 strata)
    : visibility("sample visibility", PixelFormat::RGBA32UI, strata),
      seeds("sample seeds", PixelFormat::R32UI, strata),
      surface("sample surface", PixelFormat::RGBA32UI, strata),
      guides("sample guides", PixelFormat::RGBA32F, strata),
      slope("sample slope", PixelFormat::RG32F, strata),
      motion("sample motion", PixelFormat::RGBA32F, strata),
      albedo("sample albedo", PixelFormat::RGBA32F, strata),
      emission("sample emission", PixelFormat::RGBA32F, strata),
      raw("sample raw", PixelFormat::RGBA32F, strata) {
    clearAll(all());
}

std::vector<const GpuTexture*> ExtraSamples::all() const {
    if (empty())
        return {};
    return {&visibility, &seeds, &surface, &guides, &slope, &motion, &albedo, &emission, &raw};
}

RenderTargets::RenderTargets(glm::ivec2 imageSize)
    : size(imageSize), strata(strataOf(imageSize)), ids("ids", PixelFormat::RG32UI, size),
      depth("depth", PixelFormat::Depth32F, size),
      visibility("visibility", PixelFormat::RGBA32UI, size),
      seeds("seeds", PixelFormat::R32UI, size), guides("guides", PixelFormat::RGBA32F, size),
      raw("raw", PixelFormat::RGBA32F, size), surface("surface", PixelFormat::RGBA32UI, size),
      slope("slope", PixelFormat::RG32F, size), motion("motion", PixelFormat::RGBA32F, size),
      albedo("albedo", PixelFormat::RGBA32F, size),
      emission("emission", PixelFormat::RGBA32F, size),
      owners("owners", PixelFormat::R32UI, strata), claims("claims", PixelFormat::RG32UI, strata),
      samples("samples", PixelFormat::RGBA32UI, strata), sum("sum", PixelFormat::RGBA32F, size),
      counters("counters", PixelFormat::R32UI, {int(gpu::kCounterCount), 1}) {
    filters[0] = FilterTargets(size);
    framebuffer = Framebuffer("visibility", {&ids}, &depth);
    clear();
}

void RenderTargets::swapHistories() {
    for (History* history : {&visibility, &seeds, &guides, &raw})
        history->swap();
    for (FilterTargets& filter : filters)
        if (!filter.empty()) {
            filter.color.swap();
            filter.moments.swap();
        }
}

std::vector<const GpuTexture*> RenderTargets::all() const {
    std::vector<const GpuTexture*> textures{&ids, &depth};
    for (const History* history : {&visibility, &seeds, &guides, &raw}) {
        textures.push_back(&history->current());
        textures.push_back(&history->previous());
    }
    for (const GpuTexture* texture : {&surface, &slope, &motion, &albedo, &emission, &owners,
                                      &claims, &samples, &sum, &counters})
        textures.push_back(texture);
    const auto append = [&](const std::vector<const GpuTexture*>& more) {
        textures.insert(textures.end(), more.begin(), more.end());
    };
    append(extra.all());
    for (const FilterTargets& filter : filters)
        append(filter.all());
    return textures;
}

void RenderTargets::clear() {
    clearAll(all()); // every one is a member of this object
}

std::size_t RenderTargets::bytes() const {
    std::size_t sumOfBytes = 0;
    for (const GpuTexture* texture : all())
        sumOfBytes += texture->bytes();
    return sumOfBytes;
}

} // namespace afterglow
