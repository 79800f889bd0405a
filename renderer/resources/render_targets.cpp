#include "renderer/resources/render_targets.h"

#include "shared/bindings.h"
#include "shared/counters.h"

namespace afterglow {

glm::ivec2 strataOf(glm::ivec2 size) {
    return (size + int(gpu::kStratumSize) - 1) / int(gpu::kStratumSize);
}

glm::ivec2 tilesOf(glm::ivec2 size) {
    return (size + int(gpu::kTileSize) - 1) / int(gpu::kTileSize);
}

RenderTargets::RenderTargets(glm::ivec2 imageSize)
    : size(imageSize), strata(strataOf(imageSize)), tiles(tilesOf(imageSize)),
      ids("ids", PixelFormat::RG32UI, size), depth("depth", PixelFormat::Depth32F, size),
      visibility("visibility", PixelFormat::RGBA32UI, size),
      seeds("seeds", PixelFormat::R32UI, size), guides("guides", PixelFormat::RGBA32F, size),
      raw("raw", PixelFormat::RGBA32F, size), color("color", PixelFormat::RGBA32F, size),
      moments("moments", PixelFormat::RGBA32F, size),
      surface("surface", PixelFormat::RGBA32UI, size), slope("slope", PixelFormat::RG32F, size),
      motion("motion", PixelFormat::RGBA32F, size), albedo("albedo", PixelFormat::RGBA32F, size),
      emission("emission", PixelFormat::RGBA32F, size),
      owners("owners", PixelFormat::R32UI, strata),
      samples("samples", PixelFormat::RGBA32UI, strata),
      gradientSamples("gradient samples", PixelFormat::RGBA32F, strata),
      gradient{{"gradient 0", PixelFormat::RGBA32F, strata},
               {"gradient 1", PixelFormat::RGBA32F, strata}},
      strataGuides("strata guides", PixelFormat::RGBA32F, strata),
      strataSlope("strata slope", PixelFormat::RG32F, strata),
      lambda("lambda", PixelFormat::R32F, strata),
      luminanceRange("luminance range", PixelFormat::RGBA32F, tiles),
      accumulated("accumulated", PixelFormat::RGBA32F, size),
      control("control", PixelFormat::RGBA32F, size), filtered{{"filtered 0", PixelFormat::RGBA32F,
                                                                size},
                                                               {"filtered 1", PixelFormat::RGBA32F,
                                                                size}},
      composed("composed", PixelFormat::RGBA32F, size),
      display("display", PixelFormat::RGBA8, size), sum("sum", PixelFormat::RGBA32F, size),
      counters("counters", PixelFormat::R32UI, {int(gpu::kCounterCount), 1}) {
    framebuffer = Framebuffer("visibility", {&ids}, &depth);
    clear();
}

void RenderTargets::swapHistories() {
    for (History* history : {&visibility, &seeds, &guides, &raw, &color, &moments})
        history->swap();
}

std::vector<const GpuTexture*> RenderTargets::all() const {
    std::vector<const GpuTexture*> textures{&ids, &depth};
    for (const History* history : {&visibility, &seeds, &guides, &raw, &color, &moments}) {
        textures.push_back(&history->current());
        textures.push_back(&history->previous());
    }
    for (const GpuTexture* texture :
         {&surface,  &slope,           &motion,      &albedo,      &emission,     &owners,
          &samples,  &gradientSamples, &gradient[0], &gradient[1], &strataGuides, &strataSlope,
          &lambda,   &luminanceRange,  &accumulated, &control,     &filtered[0],  &filtered[1],
          &composed, &display,         &sum,         &counters})
        textures.push_back(texture);
    return textures;
}

void RenderTargets::clear() {
    for (const GpuTexture* texture : all())
        const_cast<GpuTexture*>(texture)->clear(); // every one is a member of this object
}

std::size_t RenderTargets::bytes() const {
    std::size_t sumOfBytes = 0;
    for (const GpuTexture* texture : all())
        sumOfBytes += texture->bytes();
    return sumOfBytes;
}

} // namespace afterglow
