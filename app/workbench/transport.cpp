// SPDX-License-Identifier: MIT
#include "app/workbench/transport.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace afterglow {
namespace {

// A display that shows a frame a little early must not wait for its next turn because of it.
constexpr double kEarly = 0.002; // seconds

// Sixtieths of a second are counted, not added up: the 90th frame is at 90 / 60 to the last bit,
// as it is in an experiment.
double stepAfter(double seconds) {
    constexpr double kNear = 1e-6; // frames
    const double frames = seconds * kFixedRate, whole = std::round(frames);
    return std::abs(frames - whole) < kNear ? (whole + 1.0) / kFixedRate : seconds + kFixedStep;
}

double timeAfter(const Transport& t, double seconds, double wallSeconds) {
    if (!t.animate)
        return seconds;
    return t.timeStep == TimeStep::Fixed ? stepAfter(seconds)
                                         : seconds + std::clamp(wallSeconds, 0.0, kLongestStep);
}

/// Puts the transport before the first frame of the take that is played.
void beginRound(Transport& t) {
    Playing& playing = *t.playing;
    playing.next = 0;
    playing.frameBefore = t.frame;
    playing.secondsBefore = t.seconds;
    t.frame = playing.take.frames.front().frame;
    t.seconds = playing.take.frames.front().seconds;
    t.restoreWanted = playing.fromCheckpoint;
    t.resetWanted = !playing.fromCheckpoint;
}

void begin(Transport& t, Take take, bool loop, bool fromCheckpoint) {
    // Leaving a round that has not begun, live play goes on where it was before.
    if (t.playing && t.playing->next == 0) {
        t.frame = t.playing->frameBefore;
        t.seconds = t.playing->secondsBefore;
    }
    t.playing = Playing{.take = std::move(take), .loops = loop, .fromCheckpoint = fromCheckpoint};
    beginRound(t);
}

void resume(Transport& t) {
    t.paused = false;
    t.stepsLeft = 0;
}

int limitIndex(const Transport& t) {
    return int(std::ranges::find(kFrameLimits, t.frameLimit) - kFrameLimits.begin());
}

void changeLimit(Transport& t, int by) {
    const int index = std::clamp(limitIndex(t) + by, 0, int(kFrameLimits.size()) - 1);
    t.frameLimit = kFrameLimits[std::size_t(index)];
}

void remember(Transport& t, SceneFrame frame) {
    t.past.push_back(frame);
    if (t.past.size() > kPast)
        t.past.pop_front();
    if (t.recording)
        t.recording->frames.push_back(frame);
    t.last = std::move(frame);
}

} // namespace

bool wantsFrame(const Transport& t, double secondsSinceLastFrame) {
    return secondsUntilFrame(t, secondsSinceLastFrame) == 0.0;
}

double secondsUntilFrame(const Transport& t, double secondsSinceLastFrame) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    if (isFinished(t))
        return kNever;
    if (t.paused)
        return t.stepsLeft > 0 || !t.last ? 0.0 : kNever;
    if (t.frameLimit == 0 || !t.last)
        return 0.0;
    return std::max(0.0, 1.0 / t.frameLimit - kEarly - secondsSinceLastFrame);
}

SceneFrame nextFrame(Transport& t, const SceneFrame& live) {
    if (isFinished(t))
        throw std::logic_error("the take '" + t.playing->take.name + "' has no further frame");
    t.given = t.playing ? t.playing->take.frames[t.playing->next] : live;
    if (!t.playing) {
        t.given->frame = t.frame;
        t.given->seconds = t.seconds;
    }
    return *t.given;
}

void frameRendered(Transport& t, double wallSeconds) {
    if (!t.given)
        throw std::logic_error("a frame was rendered that nextFrame() has not given");
    remember(t, *std::exchange(t.given, {}));
    ++t.frame;
    t.seconds = timeAfter(t, t.seconds, wallSeconds);
    t.stepsLeft = std::max(t.stepsLeft - 1, 0);

    if (t.playing) {
        Playing& playing = *t.playing;
        if (++playing.next < playing.take.frames.size())
            t.seconds = playing.take.frames[playing.next].seconds;
        else if (t.recording)
            return markOut(t); // a record is of frames that follow each other
        else if (playing.loops)
            beginRound(t);
        else {
            t.paused = true;
            t.stepsLeft = 0;
        }
    }
    if (t.recording && t.recording->frames.size() >= kMostRecorded)
        markOut(t);
}

void togglePause(Transport& t) {
    if (isFinished(t)) {
        beginRound(t);
        return resume(t);
    }
    t.paused = !t.paused;
    t.stepsLeft = 0;
}

void stepOnce(Transport& t) {
    if (isFinished(t))
        return;
    t.paused = true;
    ++t.stepsLeft;
}

void slower(Transport& t) {
    changeLimit(t, 1);
}

void faster(Transport& t) {
    changeLimit(t, -1);
}

void markIn(Transport& t) {
    t.recording = Take{.name = "take-" + std::to_string(t.takesRecorded + 1)};
    t.recorded.reset();
    t.hasCheckpoint = t.checkpointWanted = true;
}

void markOut(Transport& t) {
    if (!t.recording || t.recording->frames.empty())
        return;
    t.recorded = std::exchange(t.recording, {});
    ++t.takesRecorded;
    begin(t, *t.recorded, true, t.hasCheckpoint);
}

void replay(Transport& t) {
    if (!t.recorded)
        return;
    begin(t, *t.recorded, true, t.hasCheckpoint);
    resume(t);
}

void play(Transport& t, Take take, bool loop) {
    if (take.frames.empty())
        throw std::logic_error("the take '" + take.name + "' has no frames");
    if (std::exchange(t.recording, {}) && std::exchange(t.checkpointWanted, false))
        t.hasCheckpoint = false;
    begin(t, std::move(take), loop, false);
    resume(t);
}

std::optional<SceneFrame> stopPlaying(Transport& t) {
    if (!t.playing)
        return {};
    if (isFinished(t))
        resume(t);
    if (t.playing->next == 0) { // this round has not begun: the histories stay
        t.frame = t.playing->frameBefore;
        t.seconds = t.playing->secondsBefore;
        t.resetWanted = t.restoreWanted = false;
    }
    t.playing.reset();
    // Not at once: what was played is to be seen first.
    t.repeat.first = t.frame + std::uint32_t(t.repeat.every);
    return t.last;
}

void checkpointLost(Transport& t) {
    if (!t.checkpointWanted)
        t.hasCheckpoint = false;
    if (t.playing)
        t.playing->fromCheckpoint = false;
    if (std::exchange(t.restoreWanted, false))
        t.resetWanted = true;
}

void startOver(Transport& t) {
    t = Transport{.paused = t.paused,
                  .frameLimit = t.frameLimit,
                  .animate = t.animate,
                  .timeStep = t.timeStep,
                  .repeat = {.every = t.repeat.every, .first = 0}};
    t.repeat.first = std::uint32_t(t.repeat.every);
}

bool isFinished(const Transport& t) {
    return t.playing && t.playing->next == t.playing->take.frames.size();
}

void startRepeat(Transport& t, int every) {
    t.repeat = {.every = std::max(every, 0), .first = t.frame};
}

bool repeatIsDue(const Transport& t) {
    return t.repeat.every > 0 && !t.playing && t.frame >= t.repeat.first &&
           (t.frame - t.repeat.first) % std::uint32_t(t.repeat.every) == 0;
}

} // namespace afterglow
