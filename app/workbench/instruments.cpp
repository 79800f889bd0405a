// SPDX-License-Identifier: MIT
#include "app/workbench/instruments.h"

#include "shared/counters.h"

#include <limits>
#include <utility>

namespace afterglow {
namespace {

ProbeSample sampleOf(const ProbeReading& reading, const SvgfPlan& plan) {
    ProbeSample sample{.pixels = reading.pixels,
                       .lit = reading.lit,
                       .rawLit = reading.rawLit,
                       .rawVariance = reading.rawLitVariance,
                       .variance = reading.variance,
                       .lambda = reading.lambda,
                       .alpha = reading.alpha,
                       .history = reading.history};
    if (plan.atrousIterations == 0)
        sample.variance = std::numeric_limits<double>::quiet_NaN();
    if (!plan.accumulate) { // the control image is somebody else's
        sample.lambda = sample.history = 0.0;
        sample.alpha = 1.0;
    }
    return sample;
}

/// Lambda, alpha, history length and reason; any image of that size where the filter has none.
const GpuTexture& controlOf(const Renderer& renderer, std::size_t pane, std::size_t signal) {
    const GpuTexture* const control = renderer.filterImage("alpha", pane, signal).texture;
    return control ? *control : renderer.targets().surfaces.guides;
}

} // namespace

void Instruments::measure(Renderer& renderer, const ViewState& state, std::uint32_t frame,
                          const SceneFrame& given) {
    frame_ = {.frame = frame, .marks = {}, .panes = {}, .probes = {}, .samples = {}};
    for (const std::string& mark : given.marks)
        frame_->marks.push_back({.text = mark, .step = given.step, .pane = {}});
    for (std::size_t i = 0; i < kProbes; ++i)
        if (const auto& placed = state.probes[i])
            frame_->probes[i] = rescaled(placed->probe, placed->image, renderer.size());
    for (const std::size_t pane : shownPanes(state.panes)) {
        frame_->panes[pane] = recordOf(state.panes, pane);
        measurePane(renderer, state, pane);
    }
}

void Instruments::measurePane(Renderer& renderer, const ViewState& state, std::size_t pane) {
    const RenderTargets& t = renderer.targets();
    const SvgfPlan plan = renderer.ran(pane)->planOrNone();
    const std::size_t signal = shownSignal(state, renderer.signals().size());
    const GpuTexture& control = controlOf(renderer, pane, signal);
    FrameContext context{renderer.timer()};
    for (std::size_t i = 0; i < kProbes; ++i) {
        if (!frame_->probes[i])
            continue;
        ProbePass::Inputs in{renderer.filteredSignal(pane, signal), t.signals[signal].raw.current(),
                             renderer.demodulation(signal), t.surfaces.guides, control};
        if (renderer.signals().size() > 1) {
            const std::size_t other = 1 - signal; // there are two at most
            in.other.emplace(ProbePass::OtherSignal{renderer.filteredSignal(pane, other),
                                                    t.signals[other].raw.current(),
                                                    renderer.demodulation(other)});
        }
        probe_.run(context, in, frame_->probes[i]->min, frame_->probes[i]->size);
        pendingProbes_.push_back({i, pane, plan, probe_.copyTo(readback_)});
    }
    if (!state.showInspector)
        return;
    reasons_.run(context,
                 {control, t.surfaces.guides, carriesSamples(state.panes) ? &t.samples : nullptr});
    pendingReasons_.push_back({pane, plan, reasons_.copyTo(readback_)});
}

void Instruments::count(const Renderer& renderer) {
    const GpuTexture& counters = renderer.targets().counters;
    pendingCounters_ = readback_.add<std::uint32_t>(counters, {0, 0}, counters.size());
}

void Instruments::inspect(Renderer& renderer, std::size_t pane, glm::ivec2 pixel,
                          std::size_t signal) {
    pixel_.ask(renderer, pane, pixel, signal, readback_);
    inspected_ = {pane, signal};
}

void Instruments::submit() {
    readback_.submit();
}

Instruments::Measured Instruments::collect(const Scene& scene) {
    readback_.finish();
    Measured measured{.frame = std::move(frame_), .reasons = {}, .stats = {}, .inspection = {}};
    for (const PendingProbe& pending : pendingProbes_)
        measured.frame->samples[pending.probe][pending.pane] =
            sampleOf(ProbePass::readingOf(readback_, pending.sums), pending.plan);
    for (const PendingReasons& pending : pendingReasons_) {
        ReasonCounts counts = ReasonPass::countsOf(readback_, pending.counts);
        if (!pending.plan.accumulate)
            counts.history = {};
        measured.reasons[pending.pane] = counts;
    }
    if (pendingCounters_) {
        const auto counters = readback_.pixels(*pendingCounters_);
        measured.stats = {.rays = counters[gpu::kCounterRays],
                          .gradientSamples = counters[gpu::kCounterGradientSamples],
                          .invalidValues = counters[gpu::kCounterInvalid]};
    }
    if (inspected_)
        measured.inspection =
            inspectionOf(pixel_.answer(readback_), scene, inspected_->pane, inspected_->signal);
    drop();
    return measured;
}

void Instruments::drop() {
    readback_.clear();
    frame_.reset();
    pendingProbes_.clear();
    pendingReasons_.clear();
    pendingCounters_.reset();
    inspected_.reset();
}

} // namespace afterglow
