// SPDX-License-Identifier: MIT
#include "app/measure/meter.h"

#include "app/measure/oracle.h"
#include "renderer/image/ssim.h"

#include <algorithm>
#include <numeric>

namespace afterglow {
namespace {

Image<glm::vec4> unitRange(const Image<glm::u8vec4>& image) {
    Image<glm::vec4> result(image.size());
    std::ranges::transform(image.pixels(), result.pixels().begin(),
                           [](const glm::u8vec4& c) { return glm::vec4(c) / 255.0f; });
    return result;
}

} // namespace

FrameImages readFrame(const Renderer& renderer, bool withControl, std::size_t state) {
    FrameImages images;
    images.lit = litRadiance(renderer, state);
    images.display = renderer.display(state).read<glm::u8vec4>();
    if (!withControl)
        return images;
    for (std::size_t signal = 0; signal < renderer.signals().size(); ++signal) {
        const auto channel = [&](std::string_view aov) -> Image<float> {
            const Renderer::FilterImage image = renderer.filterImage(aov, state, signal);
            if (!image.texture)
                return {};
            if (image.texture->format() == PixelFormat::R32F)
                return image.texture->read<float>();
            return channelOf(image.texture->read<glm::vec4>(), image.channel);
        };
        ControlImages& control = images.control.emplace_back();
        control.lambda = channel("lambda_strata");
        control.alpha = channel("alpha");
        if (control.alpha.size().x == 0)
            continue;
        control.history = channel("history_luminance");
        control.hasHistory = foregroundOf(renderer);
        const Image<float> reason = channel("reason");
        for (std::size_t i = 0; i < reason.pixels().size(); ++i)
            if (reason.pixels()[i] != float(gpu::kHistoryKept))
                control.hasHistory.pixels()[i] = 0;
    }
    return images;
}

Meter::Meter(const Experiment& experiment, const RunPlan& plan, const Truths& truths)
    : experiment_(experiment), plan_(plan), truths_(truths), steps_(plan.intervals.size()),
      stepKnown_(plan.intervals.size()) {}

const PictureChange* Meter::changeTo(std::size_t interval) {
    if (interval == 0 || interval >= steps_.size() || !plan_.intervals[interval].isStep())
        return nullptr;
    if (!stepKnown_[interval]) {
        stepKnown_[interval] = true;
        steps_[interval] =
            PictureChange::between(truths_.of(interval - 1).lit, truths_.of(interval).lit,
                                   &truths_.of(interval).foreground);
    }
    return steps_[interval] ? &*steps_[interval] : nullptr;
}

void Meter::keep(int frame, const FrameImages& images) {
    before_ = images.lit;
    beforeFrame_ = frame;
}

void Meter::skip(int frame, const FrameImages& images) {
    if (plan_.settled.contains(frame))
        flicker_.add(images.lit);
    keep(frame, images);
}

void Meter::measure(int frame, const FrameImages& images, MetricsTable& table,
                    const std::string& variant, FrameMaps* maps) {
    rows_.clear();
    maps_ = maps;
    measureQuality(frame, images);
    measureChange(frame, images);
    measureTrail(frame, images);
    measureControl(frame, images);
    keep(frame, images);
    for (const auto& [metric, value] : rows_)
        table.add(variant, frame, metric, value);
}

void Meter::measureQuality(int frame, const FrameImages& images) {
    const std::size_t interval = intervalAt(plan_.intervals, frame);
    const Truth& truth = truths_.of(interval);
    const Mask* mask = &truth.foreground;
    add("rmse", rmse(images.lit, truth.lit, mask));
    add("relmse", relMse(images.lit, truth.lit, mask));
    add("psnr", psnr(unitRange(images.display), unitRange(truth.display), 1.0, mask));
    add("ssim", ssim(images.display, truth.display, mask).mean);
    if (!flip_ || flipInterval_ != interval) {
        flip_.emplace(truth.display);
        flipInterval_ = interval;
    }
    MeasuredImage error = flip_->compare(images.display, mask);
    add("flip", error.mean);
    if (maps_)
        maps_->emplace_back("error", std::move(error.map));

    if (beforeFrame_ == frame - 1 && frame > 0) {
        const Truth& truthBefore = truths_.at(frame - 1);
        const Mask shared = both(truth.foreground, truthBefore.foreground);
        if (countOf(shared) > 0)
            add("temporal_error",
                temporalError(images.lit, before_, truth.lit, truthBefore.lit, &shared));
    }
    if (plan_.settled.contains(frame)) {
        flicker_.add(images.lit);
        if (frame == plan_.settled.end - 1)
            add("flicker", flicker_.mean(mask));
    }
}

void Meter::measureChange(int frame, const FrameImages& images) {
    const std::size_t interval = intervalAt(plan_.intervals, frame);
    if (const PictureChange* change = changeTo(interval)) {
        add("response", change->response(images.lit));
        add("noise", change->noise(images.lit));
    }
    // Where a filter stands before a change, on the scale of that change: see betweenOwnValues().
    const int next = plan_.intervals[interval].end;
    if (frame >= next - experiment_.settledWindow && next < experiment_.frames())
        if (const PictureChange* change = changeTo(interval + 1))
            add("response_before", change->response(images.lit));
}

void Meter::measureTrail(int frame, const FrameImages& images) {
    const int origin = std::max(0, frame - kTrailFrames);
    const std::size_t then = intervalAt(plan_.intervals, origin);
    const std::size_t now = intervalAt(plan_.intervals, frame);
    // Where the camera has moved, a pixel shows another surface.
    for (std::size_t i = then + 1; i <= now; ++i)
        if (plan_.intervals[i].changed.camera)
            return;
    if (then == now)
        return;
    const Mask counts = both(truths_.of(then).foreground, truths_.of(now).foreground);
    const auto trail = PictureChange::between(truths_.of(then).lit, truths_.of(now).lit, &counts);
    if (!trail)
        return;
    add("trail_response", trail->response(images.lit));
    add("ghost_energy", trail->ghostEnergy(images.lit));
}

// Of several signals a metric is the mean, beside those of each.
void Meter::measureControl(int frame, const FrameImages& images) {
    ofSignals_.clear();
    for (std::size_t signal = 0; signal < images.control.size(); ++signal) {
        measureLambda(frame, images.control[signal].lambda, signal);
        measureAlpha(frame, images.control[signal], signal);
    }
    for (const auto& [metric, values] : ofSignals_)
        add(metric, std::accumulate(values.begin(), values.end(), 0.0) / double(values.size()));
}

void Meter::addOfSignal(std::size_t signal, const char* metric, double value) {
    auto row = std::ranges::find(ofSignals_, metric, [](const auto& r) { return r.first; });
    if (row == ofSignals_.end())
        row = ofSignals_.emplace(row, metric, std::vector<double>{});
    row->second.push_back(value);
    if (const auto signals = signalsOf(experiment_.signal); signals.size() > 1)
        add(std::string(signals[signal].name) + ":" + metric, value);
}

void Meter::addMap(std::size_t signal, const char* name, Image<float> map) {
    if (!maps_)
        return;
    const std::string_view of = signalsOf(experiment_.signal)[signal].name;
    maps_->emplace_back(signal == 0 ? name : std::string(name) + "_" + std::string(of),
                        std::move(map));
}

void Meter::measureLambda(int frame, const Image<float>& lambda, std::size_t signal) {
    if (lambda.size().x == 0 || frame == 0)
        return;
    const std::size_t interval = intervalAt(plan_.intervals, frame);
    const auto [ideal, strata] = truths_.of(interval).idealLambda(
        signal, DenoiserSettings{}.gradient.deltaFloor, frame == plan_.intervals[interval].first);
    if (countOf(strata) == 0)
        return;
    const Agreement agreement = compareWeights(lambda, ideal, strata);
    const Detection detection = detect(lambda, ideal, strata);
    addOfSignal(signal, "lambda_mean", agreement.mean);
    addOfSignal(signal, "lambda_ideal_mean", agreement.idealMean);
    addOfSignal(signal, "lambda_bias", agreement.bias);
    addOfSignal(signal, "lambda_rmse", agreement.rmse);
    if (detection.precision)
        addOfSignal(signal, "lambda_precision", *detection.precision);
    if (detection.recall)
        addOfSignal(signal, "lambda_recall", *detection.recall);
    if (detection.falseMean)
        addOfSignal(signal, "lambda_false", *detection.falseMean);
    addMap(signal, "lambda", lambda);
    addMap(signal, "lambda_ideal", ideal);
}

void Meter::measureAlpha(int frame, const ControlImages& control, std::size_t signal) {
    if (control.alpha.size().x == 0)
        return;
    const Truth& truth = truths_.at(frame);
    const Image<float> ideal = truth.idealAlpha(signal, control.history, control.hasHistory);
    const Mask counts = both(control.hasHistory, truth.foreground);
    if (countOf(counts) > 0) {
        const Agreement agreement = compareWeights(control.alpha, ideal, counts);
        addOfSignal(signal, "alpha_mean", agreement.mean);
        addOfSignal(signal, "alpha_ideal_mean", agreement.idealMean);
        addOfSignal(signal, "alpha_bias", agreement.bias);
        addOfSignal(signal, "alpha_rmse", agreement.rmse);
    }
    addMap(signal, "alpha", control.alpha);
    addMap(signal, "alpha_ideal", ideal);
}

} // namespace afterglow
