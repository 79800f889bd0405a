// SPDX-License-Identifier: MIT
// The part of Renderer that keeps what a frame leaves for the next one, and gives it back.

#include "renderer/pipeline/renderer_impl.h"

namespace afterglow {
namespace {

std::vector<GpuTexture> copiesOf(const std::vector<GpuTexture*>& images) {
    std::vector<GpuTexture> copies;
    for (const GpuTexture* image : images)
        copies.push_back(image->copy());
    return copies;
}

void copyBack(const std::vector<GpuTexture*>& images, const std::vector<GpuTexture>& copies) {
    for (std::size_t i = 0; i < images.size(); ++i)
        images[i]->copyFrom(copies.at(i));
}

std::optional<GpuTexture> copyIfMade(const GpuTexture& image) {
    return image.size().x != 0 ? std::optional(image.copy()) : std::nullopt;
}

std::size_t bytesOf(const std::vector<GpuTexture>& images) {
    std::size_t sum = 0;
    for (const GpuTexture& image : images)
        sum += image.bytes();
    return sum;
}

} // namespace

std::size_t HistoryCheckpoint::bytes() const {
    std::size_t sum = bytesOf(images) + (exposure ? exposure->bytes() : 0);
    for (const auto& filter : filters) {
        if (!filter)
            continue;
        for (const std::vector<GpuTexture>& signal : filter->images)
            sum += bytesOf(signal);
        sum += filter->resolved ? filter->resolved->bytes() : 0;
    }
    return sum;
}

HistoryCheckpoint Renderer::checkpoint() const {
    impl_->requireScene();
    RenderTargets& t = impl_->targets;
    HistoryCheckpoint kept{.signals = impl_->signals,
                           .images = copiesOf(t.kept()),
                           .filters = {},
                           .view = impl_->frame.previous(),
                           .pose = impl_->previousPose,
                           .exposure = copyIfMade(t.exposure.current())};
    for (std::size_t i = 0; i < kFilterStates; ++i) {
        if (!impl_->states[i].ran)
            continue;
        kept.filters[i].emplace(*impl_->states[i].ran);
        for (ImageSet& own : t.filters[i].own)
            kept.filters[i]->images.push_back(copiesOf(own.kept()));
        kept.filters[i]->resolved = copyIfMade(t.filters[i].resolved.current());
    }
    return kept;
}

void Renderer::restore(const HistoryCheckpoint& kept) {
    impl_->requireScene();
    RenderTargets& t = impl_->targets;
    impl_->converging.reset();
    impl_->signals = kept.signals;
    t.setSignals(kept.signals.size());
    copyBack(t.kept(), kept.images);
    impl_->states = {};
    for (std::size_t i = 0; i < kFilterStates; ++i) {
        if (!kept.filters[i])
            continue;
        const RanFilter& ran = kept.filters[i]->ran;
        impl_->startState(i, familyOf(ran.settings.filter));
        for (std::size_t signal = 0; signal < kept.signals.size(); ++signal) {
            const std::vector<GpuTexture*> images = t.filters[i].own[signal].kept();
            copyBack(images, kept.filters[i]->images.at(signal));
            // Until the next frame has filtered.
            impl_->states[i].results[signal] = images.empty() ? nullptr : images.front();
        }
        impl_->states[i].ran = ran;
        t.filters[i].resolved = History();
        if (kept.filters[i]->resolved) {
            t.filters[i].makeResolved();
            t.filters[i].resolved.current().copyFrom(*kept.filters[i]->resolved);
        }
    }
    impl_->frame.setPrevious(kept.view);
    impl_->previousPose = kept.pose;
    t.exposure = History();
    if (kept.exposure) {
        t.makeExposure();
        t.exposure.current().copyFrom(*kept.exposure);
    }
}

} // namespace afterglow
