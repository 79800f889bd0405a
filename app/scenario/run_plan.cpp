// SPDX-License-Identifier: MIT
#include "app/scenario/run_plan.h"

#include "renderer/scene/load_scene.h"

#include <algorithm>
#include <set>

namespace afterglow {
namespace {

bool isLit(const Interval& interval, Signal signal) {
    return seesSurroundings(signal) ||
           std::ranges::any_of(interval.start.lights,
                               [](const auto& light) { return light.scale() != glm::vec3(0.0f); });
}

FrameRange settledRange(const RunPlan& plan, const Experiment& experiment) {
    const Interval* settled = &plan.intervals.back();
    for (const Interval& interval : plan.intervals)
        if (isLit(interval, experiment.signal) && interval.frames() > 1) {
            settled = &interval;
            break;
        }
    return {std::max(settled->first, settled->end - experiment.settledWindow), settled->end};
}

std::string textAt(const Timeline& timeline, FrameRange change) {
    std::string text;
    for (const TimelineEvent& event : timeline.events())
        if (frameOf(event) > 0 && change.contains(frameOf(event)))
            text += (text.empty() ? "" : ", ") + describe(event);
    return text.empty() ? "animation" : text;
}

std::vector<RunEvent> eventsOf(const RunPlan& plan, const Timeline& timeline) {
    std::vector<RunEvent> events;
    for (std::size_t i = 1; i < plan.intervals.size(); ++i) {
        const Interval& interval = plan.intervals[i];
        if (interval.isStep()) {
            events.push_back(
                {.kind = RunEvent::Kind::Step, .change = {interval.first, interval.first + 1}});
            continue;
        }
        const bool goesOn = !events.empty() && events.back().kind == RunEvent::Kind::Motion &&
                            events.back().change.end == interval.first;
        if (goesOn)
            events.back().change.end = interval.first + 1;
        else
            events.push_back(
                {.kind = RunEvent::Kind::Motion, .change = {interval.first, interval.first + 1}});
    }
    for (std::size_t i = 0; i < events.size(); ++i) {
        events[i].end = i + 1 < events.size() ? events[i + 1].change.first : timeline.frames();
        events[i].text = textAt(timeline, events[i].change);
    }
    return events;
}

// Dense where something happens for the first time, sparse afterwards.
std::vector<int> picturesOf(const std::vector<RunEvent>& events, int frames) {
    std::set<int> chosen{frames - 1};
    if (events.empty()) {
        constexpr int kPictures = 12;
        for (int i = 0; i < kPictures; ++i)
            chosen.insert((frames - 1) * i / (kPictures - 1));
    } else {
        const FrameRange change = events.front().change;
        for (const int after : {-2, -1, 0, 1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 24, 32, 48})
            chosen.insert(change.first + after);
        if (change.frames() > 1)
            for (const int after : {-8, -4, -1, 0, 1, 2, 4, 8, 16})
                chosen.insert(change.end + after);
    }
    std::vector<int> pictures;
    for (const int frame : chosen)
        if (frame >= 0 && frame < frames)
            pictures.push_back(frame);
    return pictures;
}

} // namespace

StagedRun stagedRun(const Experiment& experiment) {
    const Timeline& timeline = experiment.timeline;
    StagedRun run{.scene = timeline.staged(loadScene(experiment.scene), experiment.rate,
                                           experiment.animated, experiment.name),
                  .plan = {}};
    RunPlan& plan = run.plan;
    plan.intervals = intervalsOf(timeline, run.scene, experiment.rate);
    plan.events = eventsOf(plan, timeline);
    plan.settled = settledRange(plan, experiment);
    plan.pictures = picturesOf(plan.events, experiment.frames());
    return run;
}

} // namespace afterglow
