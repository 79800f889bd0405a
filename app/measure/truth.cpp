// SPDX-License-Identifier: MIT
#include "app/measure/truth.h"

#include <algorithm>
#include <set>

namespace afterglow {

StrataTruth Truth::idealLambda(std::size_t signal, float floor, bool isFirst) const {
    const SignalTruth& own = signals.at(signal);
    const bool changed = isFirst && own.before.size().x > 0;
    return afterglow::idealLambda(own.luminance, changed ? own.before : own.luminance, foreground,
                                  floor);
}

Image<float> Truth::idealAlpha(std::size_t signal, const Image<float>& history,
                               const Mask& hasHistory) const {
    const SignalTruth& own = signals.at(signal);
    return within(afterglow::idealAlpha(history, own.luminance, own.variance, hasHistory),
                  foreground);
}

GroundTruth::GroundTruth(Renderer& renderer, const Request& request, ReferenceStore* store)
    : renderer_(renderer), request_(request), store_(store),
      changed_(request.before &&
               changeBetween(renderer.scene(), *request.before, request.now).relights()),
      total_(changed_ ? 2 * request.samples : request.samples) {
    request_.now.seed = referenceSeed(request.now.seed);
    startOn(request_.now);
}

void GroundTruth::startOn(const FrameInput& world) {
    task_.emplace(renderer_, request_.now, world, request_.settings, request_.samples, store_);
}

int GroundTruth::advance(double milliseconds) {
    if (!task_)
        return 0;
    const int samples = task_->advance(milliseconds);
    done_ += samples;
    if (!task_->isDone())
        return samples;
    const bool isOfNow = truth_.signals.empty();
    if (isOfNow)
        keepNow();
    else
        for (std::size_t i = 0; i < truth_.signals.size(); ++i)
            truth_.signals[i].before = luminanceOf(task_->result().signals[i]);
    // Light and shadow on these surfaces do not depend on the camera: if it alone has moved, they
    // reflected just the same one frame ago.
    if (isOfNow && changed_)
        startOn(*request_.before);
    else
        task_.reset();
    return samples;
}

void GroundTruth::keepNow() {
    truth_.lit = litRadiance(renderer_);
    truth_.display = renderer_.display().read<glm::u8vec4>();
    truth_.foreground = foregroundOf(renderer_);
    truth_.residual = task_->result().residual;
    truth_.milliseconds = task_->result().milliseconds;
    for (const Image<glm::vec4>& signal : task_->result().signals)
        truth_.signals.push_back({luminanceOf(signal), channelOf(signal, 3)});
}

FrameInput inputAt(const Experiment& experiment, const RunPlan& plan, int frame) {
    const Interval& interval = plan.intervals[intervalAt(plan.intervals, frame)];
    FrameInput input = interval.start.input(experiment.seed);
    input.frame = std::uint32_t(frame);
    input.seconds = experiment.seconds(frame);
    return input;
}

Truths::Truths(const Experiment& experiment, const RunPlan& plan)
    : experiment_(experiment), plan_(plan), truths_(plan.intervals.size()) {}

std::vector<std::size_t> Truths::neededFor(FrameRange range) const {
    const std::vector<Interval>& intervals = plan_.intervals;
    std::set<std::size_t> needed;
    const std::size_t first = intervalAt(intervals, std::max(0, range.first - kTrailFrames));
    const std::size_t last = intervalAt(intervals, range.end - 1);
    for (std::size_t i = first; i <= last; ++i)
        needed.insert(i);
    // The change to come, of which the frames before it show nothing yet.
    if (last + 1 < intervals.size() && intervals[last + 1].isStep() &&
        intervals[last + 1].first - experiment_.settledWindow < range.end)
        needed.insert(last + 1);
    // A step is from the interval before.
    if (intervals[first].isStep() && first > 0)
        needed.insert(first - 1);
    return {needed.begin(), needed.end()};
}

int Truths::countFor(FrameRange range) const {
    int count = 0;
    for (const std::size_t i : neededFor(range)) {
        const Interval& interval = plan_.intervals[i];
        count += 1 + int(interval.changed.relights() && range.contains(interval.first));
    }
    return count;
}

void Truths::make(Renderer& renderer, ReferenceStore& store, FrameRange range,
                  const std::function<void(int)>& advanced) {
    Settings settings;
    settings.lighting.signal = int(experiment_.signal);
    for (const std::size_t i : neededFor(range)) {
        const int first = plan_.intervals[i].first;
        GroundTruth::Request request{.now = inputAt(experiment_, plan_, first),
                                     .before = {},
                                     .settings = settings,
                                     .samples = experiment_.referenceSamples};
        if (first > 0 && range.contains(first))
            request.before = inputAt(experiment_, plan_, first - 1);
        GroundTruth truth(renderer, request, &store);
        while (!truth.isDone())
            advanced(truth.advance(kPortionMilliseconds));
        truths_[i] = truth.take();
    }
}

} // namespace afterglow
