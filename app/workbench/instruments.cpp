#include "app/workbench/instruments.h"

#include <limits>

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

ProbeFrame Instruments::read(Renderer& renderer, const ViewState& state, std::uint32_t frame,
                             const FrameMoment& moment) {
    ProbeFrame result{.frame = frame, .marks = {}, .panes = {}, .probes = {}, .samples = {}};
    for (const std::string& mark : moment.marks)
        result.marks.push_back({.text = mark, .step = moment.step, .pane = {}});
    const auto shown = shownPanes(state.panes);
    for (const std::size_t pane : shown)
        result.panes[pane] = titleOf(state.panes.all[pane]);
    FrameContext context{renderer.timer()};
    const RenderTargets& t = renderer.targets();
    const std::size_t signal = shownSignal(state);
    for (std::size_t i = 0; i < kProbes; ++i) {
        if (!state.probes[i])
            continue;
        const Probe probe =
            rescaled(state.probes[i]->probe, state.probes[i]->image, renderer.size());
        result.probes[i] = probe;
        for (const std::size_t pane : shown) {
            probe_.run(context,
                       {renderer.filteredSignal(pane, signal), t.signals[signal].raw.current(),
                        renderer.demodulation(signal), t.surfaces.guides,
                        controlOf(renderer, pane, signal)},
                       probe.min, probe.size);
            result.samples[i][pane] = sampleOf(probe_.read(), *renderer.ran(pane)->svgf);
        }
    }
    return result;
}

ReasonCounts Instruments::countReasons(Renderer& renderer, const ViewState& state,
                                       std::size_t pane) {
    const RenderTargets& t = renderer.targets();
    FrameContext context{renderer.timer()};
    reasons_.run(context, {controlOf(renderer, pane, shownSignal(state)), t.surfaces.guides,
                           carriesSamples(state.panes) ? &t.samples : nullptr});
    ReasonCounts counts = reasons_.read();
    if (!renderer.ran(pane)->svgf->accumulate)
        counts.history = {};
    return counts;
}

} // namespace afterglow
