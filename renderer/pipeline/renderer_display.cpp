// SPDX-License-Identifier: MIT
// The part of Renderer from the filtered signals to the display.

#include "renderer/pipeline/renderer_impl.h"

#include <cmath>

namespace afterglow {

void Renderer::Impl::compose(FrameContext& context, std::size_t state) {
    RenderTargets& t = targets;
    std::vector<CompositePass::Term> terms;
    for (std::size_t i = 0; i < signals.size(); ++i)
        terms.push_back({*states[state].results[i], demodulation(i)});
    composite.run(context, {terms, t.surfaces.emission, t.surfaces.guides},
                  {t.filters[state].composed});
}

// The exposure that the picture of this state asks for.
void Renderer::Impl::expose(FrameContext context, std::size_t state,
                            const DisplaySettings& display) {
    RenderTargets& t = targets;
    if (display.autoExposure == 0) {
        t.luminanceSums = {};
        t.exposure = History();
        return;
    }
    if (t.luminanceSums.size().x == 0)
        t.luminanceSums =
            GpuTexture("luminance sums", PixelFormat::RGBA32F, tilesOf(t.surfaces.size()));
    t.makeExposure();
    context.prefix.clear(); // it is of the frame
    const float adaptation = float(1.0 - std::exp(-1.0 / double(display.exposureFrames)));
    autoExposure.run(context, {t.filters[state].composed, t.surfaces.guides, t.exposure.previous()},
                     {t.luminanceSums, t.exposure.current()},
                     {adaptation, display.exposureLimit, 0.0f, 0.0f});
}

const GpuTexture& Renderer::Impl::antiAlias(FrameContext& context, FilterTargets& shown,
                                            const GpuTexture& color, const GpuTexture* exposure,
                                            const gpu::TaaParams& params) {
    shown.makeResolved();
    taa.run(context,
            {color, targets.surfaces.guides, targets.surfaces.motion, shown.resolved.previous(),
             exposure},
            {shown.resolved.current()}, params);
    return shown.resolved.current();
}

// From linear radiance to the display.
const GpuTexture& Renderer::Impl::present(FrameContext& context, std::size_t state,
                                          const DisplaySettings& display) {
    FilterTargets& shown = targets.filters[state];
    const GpuTexture* const exposure =
        display.autoExposure != 0 ? &targets.exposure.current() : nullptr;
    const float byHand = std::exp2(display.exposure);
    const bool smooths = AntiAliasing(display.antiAliasing) == AntiAliasing::Taa;
    const bool mapsFirst = smooths && TaaOrder(display.taaOrder) == TaaOrder::AfterToneMap;
    if (!smooths)
        shown.resolved = History();
    if (!mapsFirst)
        shown.toned = {};
    if (!mapsFirst) {
        const GpuTexture& color = smooths
                                      ? antiAlias(context, shown, shown.composed, exposure,
                                                  {display.taaBlend, display.taaClip, byHand, 1})
                                      : shown.composed;
        tonemap.run(context, {color, exposure}, shown.display, display.toneMapper,
                    {byHand, 1, 0.0f, 0.0f});
        return shown.display;
    }
    if (shown.toned.size().x == 0)
        shown.toned = GpuTexture("toned", PixelFormat::RGBA32F, shown.composed.size());
    tonemap.run(context, {shown.composed, exposure}, shown.toned, display.toneMapper,
                {byHand, 0, 0.0f, 0.0f});
    const GpuTexture& color = antiAlias(context, shown, shown.toned, nullptr,
                                        {display.taaBlend, display.taaClip, 1.0f, 0});
    tonemap.run(context, {color}, shown.display, gpu::kToneNone, {1.0f, 1, 0.0f, 0.0f});
    return shown.display;
}

// A reference is one picture: there is nothing before it to be averaged with or to adapt from.
const GpuTexture& Renderer::Impl::presentReference(FrameContext& context, DisplaySettings display) {
    compose(context, 0);
    targets.exposure = History();
    expose(context, 0, display);
    display.antiAliasing = int(AntiAliasing::Off);
    return present(context, 0, display);
}

} // namespace afterglow
