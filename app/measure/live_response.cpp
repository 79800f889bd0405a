// SPDX-License-Identifier: MIT
#include "app/measure/live_response.h"

#include "app/measure/response.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <fmt/format.h>

namespace afterglow {
namespace {

constexpr std::size_t kBeforeFrames = 16;
constexpr int kSettledWindow = 16;
constexpr int kSettledAfter = 48;       ///< frames after the event
constexpr std::size_t kLeastCurve = 24; ///< frames of a response that was cut short
constexpr double kErrors = 4.0;         ///< standard errors that make a step of the pane
constexpr double kSignalErrors = 3.0;   ///< and of the noisy signal
constexpr double kLeastStep = 0.02;     ///< of the larger level

using Samples = std::vector<const ProbeSample*>;

struct Level {
    double mean = 0.0;
    double error = std::numeric_limits<double>::infinity(); ///< infinite: not known
};

double sumOfSquares(std::span<const ProbeSample* const> samples, double ProbeSample::*value,
                    double mean) {
    double sum = 0.0;
    for (const ProbeSample* sample : samples)
        sum += (sample->*value - mean) * (sample->*value - mean);
    return sum;
}

double meanOf(std::span<const ProbeSample* const> samples, double ProbeSample::*value) {
    double sum = 0.0;
    for (const ProbeSample* sample : samples)
        sum += sample->*value;
    return sum / double(samples.size());
}

/// The mean of the noisy signal. Its error is the larger of two that each can miss something: from
/// the differences between pixels, which one pixel does not have, and from those between frames,
/// which few frames do not show.
Level noisyLevel(std::span<const ProbeSample* const> samples) {
    constexpr std::size_t kLeastFrames = 6;
    constexpr std::uint64_t kLeastValues = 16;
    const double frames = double(samples.size());
    Level level{.mean = meanOf(samples, &ProbeSample::rawLit)};
    double square = -1.0;
    std::uint64_t values = 0;
    double within = 0.0;
    for (const ProbeSample* sample : samples) {
        values += sample->pixels > 1 ? sample->pixels : 0;
        within += sample->rawVariance / double(sample->pixels);
    }
    if (values >= kLeastValues)
        square = within / (frames * frames);
    if (samples.size() >= kLeastFrames) {
        // Not / frames: the fewer they are the further can their differences be too small. This is
        // the variance of Student's distribution.
        const double between = sumOfSquares(samples, &ProbeSample::rawLit, level.mean);
        square = std::max(square, between / (frames - 1.0) / (frames - 3.0));
    }
    if (square >= 0.0)
        level.error = std::sqrt(square);
    return level;
}

/// The mean of what the pane shows, while it was given a signal of that noise. It has no more noise
/// than the mean of the noise that went into it; where the filter also takes from the neighborhood
/// it has much less, and that shows in how much it differs from frame to frame. Successive frames
/// are much alike, so that a window sees only a part of the differences, and its mean has as much
/// noise as one frame.
Level shownLevel(std::span<const ProbeSample* const> samples, const Level& noisy) {
    constexpr std::size_t kLeastFrames = 16;
    constexpr double kUnseen = 2.0;
    Level level{.mean = meanOf(samples, &ProbeSample::lit), .error = noisy.error};
    if (samples.size() >= kLeastFrames) {
        const double between = sumOfSquares(samples, &ProbeSample::lit, level.mean);
        level.error =
            std::min(level.error, kUnseen * std::sqrt(between / double(samples.size() - 1)));
    }
    return level;
}

bool isStep(const Level& before, const Level& after, double errors) {
    const double step = std::abs(after.mean - before.mean);
    const double larger = std::max(std::abs(after.mean), std::abs(before.mean));
    return step > 0.0 && step >= errors * std::hypot(before.error, after.error) &&
           step >= kLeastStep * larger;
}

/// A step that is known to be below the least one. What is neither this nor a step is hidden by
/// noise.
bool isTooSmall(const Level& before, const Level& after, double errors) {
    const double step = std::abs(after.mean - before.mean);
    const double larger = std::max(std::abs(after.mean), std::abs(before.mean));
    return step + errors * std::hypot(before.error, after.error) <= kLeastStep * larger;
}

bool concerns(const ProbeMark& mark, std::size_t pane) {
    return !mark.pane || *mark.pane == pane;
}

bool isQuiet(const ProbeFrame& frame, std::size_t pane) {
    return std::ranges::none_of(frame.marks,
                                [&](const ProbeMark& mark) { return concerns(mark, pane); });
}

bool isStepAlone(const ProbeFrame& frame, std::size_t pane) {
    return !isQuiet(frame, pane) && std::ranges::all_of(frame.marks, [&](const ProbeMark& mark) {
        return mark.step || !concerns(mark, pane);
    });
}

/// Whether the frame is rendered after the one that stands before it, and not after a jump.
bool follows(const ProbeLog& log, std::size_t index) {
    return index > 0 && log.frames()[index].frame == log.frames()[index - 1].frame + 1;
}

Samples samplesBefore(const ProbeLog& log, std::size_t probe, std::size_t pane, std::size_t event) {
    Samples samples;
    for (std::size_t i = event; samples.size() < kBeforeFrames && follows(log, i); --i) {
        const ProbeSample* sample = log.measured(i - 1, probe, pane);
        if (!sample || !isQuiet(log.frames()[i - 1], pane))
            break;
        samples.push_back(sample);
    }
    return samples;
}

Samples samplesSince(const ProbeLog& log, std::size_t probe, std::size_t pane, std::size_t event) {
    Samples samples;
    for (std::size_t i = event; i < log.frames().size(); ++i) {
        const ProbeSample* sample = log.measured(i, probe, pane);
        if (!sample || (i > event && (!follows(log, i) || !isQuiet(log.frames()[i], pane))))
            break;
        samples.push_back(sample);
    }
    return samples;
}

std::string namesOf(const ProbeFrame& frame, std::size_t pane) {
    std::string names;
    for (const ProbeMark& mark : frame.marks)
        if (concerns(mark, pane))
            names += (names.empty() ? "" : ", ") + mark.text;
    return names;
}

void claim(LiveResponse& response, LiveResponse::Status status, const Level& target,
           std::vector<double> p) {
    const ResponseSummary summary = summarize(p);
    response.status = status;
    response.target = target.mean;
    response.targetError = target.error;
    response.p = std::move(p);
    response.t50 = summary.t50;
    response.t90 = summary.t90;
    response.ghostFrames = summary.ghostFrames;
}

std::vector<double> between(const Samples& shown, double before, double target) {
    std::vector<double> p;
    for (const ProbeSample* sample : shown)
        p.push_back((sample->lit - before) / (target - before));
    return p;
}

} // namespace

LiveResponse liveResponse(const ProbeLog& log, std::size_t probe, std::size_t pane,
                          std::string_view settings) {
    for (std::size_t i = log.frames().size(); i-- > 0;) {
        const ProbeFrame& frame = log.frames()[i];
        if (!isStepAlone(frame, pane))
            continue;
        if (frame.panes[pane].settings == settings)
            return responseTo(log, probe, pane, i);
        LiveResponse response;
        response.status = LiveResponse::Status::NotMeasured;
        response.event = namesOf(frame, pane);
        response.over = true;
        return response;
    }
    return {};
}

LiveResponse responseTo(const ProbeLog& log, std::size_t probe, std::size_t pane,
                        std::size_t index) {
    using Status = LiveResponse::Status;
    LiveResponse response;
    if (!isStepAlone(log.frames().at(index), pane))
        return response;
    const auto& box = log.frames()[index].probes.at(probe);
    response.isOnePixel = box && box->size == glm::ivec2(1);
    response.event = namesOf(log.frames()[index], pane);
    const Samples past = samplesBefore(log, probe, pane, index);
    const Samples shown = samplesSince(log, probe, pane, index);
    response.framesSince = std::max(0, int(shown.size()) - 1);
    response.over = index + shown.size() < log.frames().size();
    response.status = response.over ? Status::NotMeasured : Status::Waiting;
    if (past.empty() || shown.empty())
        return response;

    const Level lightBefore = noisyLevel(past), light = noisyLevel(shown);
    const Level before = shownLevel(past, lightBefore);
    response.before = before.mean;
    response.target = light.mean;
    if (!std::isfinite(before.error) || !std::isfinite(light.error))
        return response;
    response.targetError = light.error;
    response.status =
        isTooSmall(lightBefore, light, kSignalErrors) ? Status::TooSmall : Status::TooNoisy;
    // A pane that is still on its way from an event before this one moves all the same.
    if (!isStep(lightBefore, light, kSignalErrors))
        return response;

    const bool isLiveStep = isStep(before, light, kErrors);
    if (response.framesSince >= kSettledAfter || (response.over && shown.size() >= kLeastCurve)) {
        const auto last = std::span(shown).last(kSettledWindow);
        const Level own = shownLevel(last, noisyLevel(last));
        // A pane that has hardly begun to move by now has not settled: the new light is elsewhere.
        const bool hasMoved =
            !isLiveStep ||
            betweenOwnValues({}, 0.0, (own.mean - before.mean) / (light.mean - before.mean));
        if (hasMoved && isStep(before, own, kErrors)) {
            claim(response, Status::Settled, own, between(shown, before.mean, own.mean));
            return response;
        }
    }
    if (isLiveStep)
        claim(response, Status::Live, light, between(shown, before.mean, light.mean));
    return response;
}

std::string timeText(const LiveResponse& response, const std::optional<int>& frames) {
    if (frames)
        return std::to_string(*frames);
    return response.over ? fmt::format("> {}", response.framesSince) : "not yet";
}

std::string ghostText(const LiveResponse& response) {
    return fmt::format("{}{:.1f}", response.over && !response.t90 ? "> " : "",
                       response.ghostFrames);
}

std::string statusText(const LiveResponse& response) {
    using Status = LiveResponse::Status;
    if (response.event.empty())
        return "no change yet";
    switch (response.status) {
    case Status::Waiting: return "measuring";
    case Status::NotMeasured: return "not measured";
    case Status::TooSmall: return "step too small";
    case Status::TooNoisy: return response.isOnePixel ? "pixel too noisy" : "too noisy";
    case Status::Live:
        return response.over ? "cut short" : fmt::format("live, {}", response.framesSince);
    case Status::Settled: return "settled";
    }
    return {};
}

std::string describe(const LiveResponse& response) {
    using Status = LiveResponse::Status;
    if (response.event.empty())
        return "no change of light yet";
    if (!response.claimed())
        return response.event + ": " + statusText(response);
    const bool isLive = response.status == Status::Live;
    return fmt::format("{}: t50 {}, t90 {}, {} ghost frames{} ({})", response.event,
                       timeText(response, response.t50), timeText(response, response.t90),
                       ghostText(response), isLive && !response.over ? " so far" : "",
                       statusText(response));
}

} // namespace afterglow
