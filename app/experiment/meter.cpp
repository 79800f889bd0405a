#include "app/experiment/meter.h"

#include "app/experiment/oracle.h"
#include "renderer/image/ssim.h"
#include "renderer/pipeline/aov.h"

#include <algorithm>

namespace afterglow {
namespace {

/// Of the history that was fetched at each pixel: the temporal pass leaves it in the alpha of its
/// blend, which is the history itself where nothing is fed back from the spatial filter.
Image<float> historyLuminance(const FilterTargets& t, const DenoisePlan& plan) {
    const GpuTexture& blend = plan.feedbackIteration == 0 ? t.color.current() : t.accumulated;
    return channelOf(blend.read<glm::vec4>(), 3);
}

Image<glm::vec4> unitRange(const Image<glm::u8vec4>& image) {
    Image<glm::vec4> result(image.size());
    std::ranges::transform(image.pixels(), result.pixels().begin(),
                           [](const glm::u8vec4& c) { return glm::vec4(c) / 255.0f; });
    return result;
}

} // namespace

FrameImages readFrame(const Renderer& renderer, const Settings& settings, bool withControl,
                      std::size_t state) {
    const FilterTargets& own = renderer.targets().filters.at(state);
    FrameImages images;
    images.lit = litRadiance(renderer, state);
    images.display = own.display.read<glm::u8vec4>();
    const DenoisePlan plan = makePlan(settings.filter, settings.denoiser);
    if (withControl && plan.useLambda)
        images.lambda = own.lambda.read<float>();
    if (withControl && plan.accumulate) {
        const auto control = own.control.read<glm::vec4>();
        images.alpha = channelOf(control, 1);
        images.history = historyLuminance(own, plan);
        images.hasHistory = foregroundOf(renderer);
        for (std::size_t i = 0; i < control.pixels().size(); ++i)
            if (control.pixels()[i].w != float(gpu::kHistoryKept))
                images.hasHistory.pixels()[i] = 0;
    }
    return images;
}

Meter::Meter(const Experiment& experiment, const RunPlan& plan, const Truths& truths)
    : experiment_(experiment), plan_(plan), truths_(truths), steps_(plan.moments.size()),
      stepKnown_(plan.moments.size()) {}

const PictureChange* Meter::changeTo(std::size_t moment) {
    if (moment == 0 || moment >= steps_.size() || !plan_.moments[moment].isStep())
        return nullptr;
    if (!stepKnown_[moment]) {
        stepKnown_[moment] = true;
        steps_[moment] = PictureChange::between(truths_.of(moment - 1).lit, truths_.of(moment).lit,
                                                &truths_.of(moment).foreground);
    }
    return steps_[moment] ? &*steps_[moment] : nullptr;
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
    const std::size_t moment = momentAt(plan_.moments, frame);
    const Truth& truth = truths_.of(moment);
    const Mask* mask = &truth.foreground;
    add("rmse", rmse(images.lit, truth.lit, mask));
    add("relmse", relMse(images.lit, truth.lit, mask));
    add("psnr", psnr(unitRange(images.display), unitRange(truth.display), 1.0, mask));
    add("ssim", ssim(images.display, truth.display, mask).mean);
    if (!flip_ || flipMoment_ != moment) {
        flip_.emplace(truth.display);
        flipMoment_ = moment;
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
    const std::size_t moment = momentAt(plan_.moments, frame);
    if (const PictureChange* change = changeTo(moment)) {
        add("response", change->response(images.lit));
        add("noise", change->noise(images.lit));
    }
    // Where a filter stands before a change, on the scale of that change: see betweenOwnValues().
    const int next = plan_.moments[moment].end;
    if (frame >= next - experiment_.settledWindow && next < experiment_.frames())
        if (const PictureChange* change = changeTo(moment + 1))
            add("response_before", change->response(images.lit));
}

void Meter::measureTrail(int frame, const FrameImages& images) {
    const int origin = std::max(0, frame - kTrailFrames);
    const std::size_t then = momentAt(plan_.moments, origin);
    const std::size_t now = momentAt(plan_.moments, frame);
    // Where the camera has moved, a pixel shows another surface.
    for (std::size_t i = then + 1; i <= now; ++i)
        if (plan_.moments[i].cameraMoved)
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

void Meter::measureControl(int frame, const FrameImages& images) {
    const std::size_t moment = momentAt(plan_.moments, frame);
    const Truth& truth = truths_.of(moment);
    const bool isFirst = frame == plan_.moments[moment].first;
    const Mask& strata = isFirst ? truth.litFirst : truth.litLater;
    if (images.lambda.size().x != 0 && frame > 0 && countOf(strata) > 0) {
        const Image<float> ideal = isFirst ? truth.idealLambda : Image<float>(images.lambda.size());
        const Agreement agreement = compareWeights(images.lambda, ideal, strata);
        const Detection detection = detect(images.lambda, ideal, strata);
        add("lambda_mean", agreement.mean);
        add("lambda_ideal_mean", agreement.idealMean);
        add("lambda_bias", agreement.bias);
        add("lambda_rmse", agreement.rmse);
        if (detection.precision)
            add("lambda_precision", *detection.precision);
        if (detection.recall)
            add("lambda_recall", *detection.recall);
        if (detection.falseMean)
            add("lambda_false", *detection.falseMean);
        if (maps_) {
            maps_->emplace_back("lambda", images.lambda);
            maps_->emplace_back("lambda_ideal", ideal);
        }
    }
    if (images.alpha.size().x != 0) {
        const Image<float> ideal =
            idealAlpha(images.history, truth.luminance, truth.variance, images.hasHistory);
        const Mask counts = both(images.hasHistory, truth.foreground);
        if (countOf(counts) > 0) {
            const Agreement agreement = compareWeights(images.alpha, ideal, counts);
            add("alpha_mean", agreement.mean);
            add("alpha_ideal_mean", agreement.idealMean);
            add("alpha_bias", agreement.bias);
            add("alpha_rmse", agreement.rmse);
        }
        if (maps_) {
            maps_->emplace_back("alpha", images.alpha);
            maps_->emplace_back("alpha_ideal", within(ideal, truth.foreground));
        }
    }
}

} // namespace afterglow
