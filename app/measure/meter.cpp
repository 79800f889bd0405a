// SPDX-License-Identifier: MIT
#include "app/measure/meter.h"

#include "app/measure/oracle.h"
#include "renderer/base/parallel.h"
#include "renderer/image/ssim.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>

namespace afterglow {
namespace {

Image<glm::vec4> unitRange(const Image<glm::u8vec4>& image) {
    Image<glm::vec4> result(image.size());
    std::ranges::transform(image.pixels(), result.pixels().begin(),
                           [](const glm::u8vec4& c) { return glm::vec4(c) / 255.0f; });
    return result;
}

/// The measures of the signals of a frame. Of several signals a metric is their mean, beside those
/// of each.
class ControlFindings {
public:
    explicit ControlFindings(std::span<const SignalInfo> signals) : signals_(signals) {}

    void add(std::size_t signal, const char* metric, double value) {
        auto row = std::ranges::find(values_, metric, [](const auto& r) { return r.first; });
        if (row == values_.end())
            row = values_.emplace(row, metric, std::vector<double>{});
        row->second.push_back(value);
        if (signals_.size() > 1)
            rows.emplace_back(std::string(signals_[signal].name) + ":" + metric, value);
    }
    void addMap(std::size_t signal, const char* name, Image<float> map) {
        maps.emplace_back(
            signal == 0 ? name : std::string(name) + "_" + std::string(signals_[signal].name),
            std::move(map));
    }
    void addMeans() {
        for (const auto& [metric, values] : values_)
            rows.emplace_back(metric, std::accumulate(values.begin(), values.end(), 0.0) /
                                          double(values.size()));
    }

    std::vector<std::pair<std::string, double>> rows{};
    FrameMaps maps{};

private:
    std::span<const SignalInfo> signals_;
    std::vector<std::pair<std::string, std::vector<double>>> values_{}; ///< by metric
};

void measureLambda(const Truth& truth, bool isFirst, const Image<float>& lambda, std::size_t signal,
                   ControlFindings& found) {
    const auto [ideal, strata] =
        truth.idealLambda(signal, DenoiserSettings{}.gradient.deltaFloor, isFirst);
    if (countOf(strata) == 0)
        return;
    const Agreement agreement = compareWeights(lambda, ideal, strata);
    const Detection detection = detect(lambda, ideal, strata);
    found.add(signal, "lambda_mean", agreement.mean);
    found.add(signal, "lambda_ideal_mean", agreement.idealMean);
    found.add(signal, "lambda_bias", agreement.bias);
    found.add(signal, "lambda_rmse", agreement.rmse);
    if (detection.precision)
        found.add(signal, "lambda_precision", *detection.precision);
    if (detection.recall)
        found.add(signal, "lambda_recall", *detection.recall);
    if (detection.falseMean)
        found.add(signal, "lambda_false", *detection.falseMean);
    found.addMap(signal, "lambda", lambda);
    found.addMap(signal, "lambda_ideal", ideal);
}

void measureAlpha(const Truth& truth, const ControlImages& control, std::size_t signal,
                  ControlFindings& found) {
    const Image<float> ideal = truth.idealAlpha(signal, control.history, control.hasHistory);
    const Mask counts = both(control.hasHistory, truth.foreground);
    if (countOf(counts) > 0) {
        const Agreement agreement = compareWeights(control.alpha, ideal, counts);
        found.add(signal, "alpha_mean", agreement.mean);
        found.add(signal, "alpha_ideal_mean", agreement.idealMean);
        found.add(signal, "alpha_bias", agreement.bias);
        found.add(signal, "alpha_rmse", agreement.rmse);
    }
    found.addMap(signal, "alpha", control.alpha);
    found.addMap(signal, "alpha_ideal", ideal);
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
    // Each has members of its own among those that change. The first ones take longest.
    enum Part { kFlip, kSimilarity, kControl, kError, kTime, kChange, kTrail, kParts };
    std::array<Findings, kParts> found;
    parallelFor(kParts, hardwareThreads(), [&](std::size_t part) {
        switch (Part(part)) {
        case kFlip: return measureFlip(frame, images, found[part]);
        case kSimilarity: return measureSimilarity(frame, images, found[part]);
        case kControl: return measureControl(frame, images, found[part]);
        case kError: return measureError(frame, images, found[part]);
        case kTime: return measureTime(frame, images, found[part]);
        case kChange: return measureChange(frame, images, found[part]);
        case kTrail: return measureTrail(frame, images, found[part]);
        case kParts: break;
        }
    });
    keep(frame, images);
    for (const Part part : {kError, kSimilarity, kFlip, kTime, kChange, kTrail, kControl}) {
        for (const auto& [metric, value] : found[part].rows)
            table.add(variant, frame, metric, value);
        if (maps)
            std::ranges::move(found[part].maps, std::back_inserter(*maps));
    }
}

void Meter::measureError(int frame, const FrameImages& images, Findings& found) const {
    const Truth& truth = truths_.at(frame);
    const Mask* mask = &truth.foreground;
    found.add("rmse", rmse(images.lit, truth.lit, mask));
    found.add("relmse", relMse(images.lit, truth.lit, mask));
    found.add("psnr", psnr(unitRange(images.display), unitRange(truth.display), 1.0, mask));
}

void Meter::measureSimilarity(int frame, const FrameImages& images, Findings& found) const {
    const Truth& truth = truths_.at(frame);
    found.add("ssim", ssim(images.display, truth.display, &truth.foreground).mean);
}

void Meter::measureFlip(int frame, const FrameImages& images, Findings& found) {
    const std::size_t interval = intervalAt(plan_.intervals, frame);
    const Truth& truth = truths_.of(interval);
    if (!flip_ || flipInterval_ != interval) {
        flip_.emplace(truth.display);
        flipInterval_ = interval;
    }
    MeasuredImage error = flip_->compare(images.display, &truth.foreground);
    found.add("flip", error.mean);
    found.maps.emplace_back("error", std::move(error.map));
}

void Meter::measureTime(int frame, const FrameImages& images, Findings& found) {
    const Truth& truth = truths_.at(frame);
    if (beforeFrame_ == frame - 1 && frame > 0) {
        const Truth& truthBefore = truths_.at(frame - 1);
        const Mask shared = both(truth.foreground, truthBefore.foreground);
        if (countOf(shared) > 0)
            found.add("temporal_error",
                      temporalError(images.lit, before_, truth.lit, truthBefore.lit, &shared));
    }
    if (plan_.settled.contains(frame)) {
        flicker_.add(images.lit);
        if (frame == plan_.settled.end - 1)
            found.add("flicker", flicker_.mean(&truth.foreground));
    }
}

void Meter::measureChange(int frame, const FrameImages& images, Findings& found) {
    const std::size_t interval = intervalAt(plan_.intervals, frame);
    if (const PictureChange* change = changeTo(interval)) {
        found.add("response", change->response(images.lit));
        found.add("noise", change->noise(images.lit));
    }
    // Where a filter stands before a change, on the scale of that change: see betweenOwnValues().
    const int next = plan_.intervals[interval].end;
    if (frame >= next - experiment_.settledWindow && next < experiment_.frames())
        if (const PictureChange* change = changeTo(interval + 1))
            found.add("response_before", change->response(images.lit));
}

void Meter::measureTrail(int frame, const FrameImages& images, Findings& found) const {
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
    found.add("trail_response", trail->response(images.lit));
    found.add("ghost_energy", trail->ghostEnergy(images.lit));
}

void Meter::measureControl(int frame, const FrameImages& images, Findings& found) const {
    const std::size_t interval = intervalAt(plan_.intervals, frame);
    const Truth& truth = truths_.of(interval);
    const bool isFirst = frame == plan_.intervals[interval].first;
    ControlFindings control(signalsOf(experiment_.signal));
    for (std::size_t signal = 0; signal < images.control.size(); ++signal) {
        const ControlImages& of = images.control[signal];
        if (of.lambda.size().x > 0 && frame > 0)
            measureLambda(truth, isFirst, of.lambda, signal, control);
        if (of.alpha.size().x > 0)
            measureAlpha(truth, of, signal, control);
    }
    control.addMeans();
    found.rows = std::move(control.rows);
    found.maps = std::move(control.maps);
}

} // namespace afterglow
