// SPDX-License-Identifier: MIT
#include "app/scenario/timeline.h"

#include "renderer/base/error.h"
#include "renderer/base/names.h"
#include "renderer/pipeline/renderer.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace afterglow {
namespace {

constexpr std::string_view kAllLights = "*";

std::string describeLight(const LightEvent& event) {
    std::string text = event.light == kAllLights ? "all lights" : event.light;
    if (event.on)
        text += *event.on ? " on" : " off";
    if (event.power)
        text += fmt::format(" to {:.4g} %", double(*event.power) * 100.0);
    if (event.tint)
        text += *event.tint == glm::vec3(1.0f) ? " untinted" : " tinted";
    return text;
}

/// The end of a motion, and what it moves: a node's name, or nothing for the camera.
struct Span {
    int frame, until;
    std::string_view node;
};

std::optional<Span> spanOf(const TimelineEvent& event) {
    if (const auto* motion = std::get_if<NodeMotion>(&event))
        return Span{motion->frame, motion->until, motion->node};
    if (const auto* move = std::get_if<CameraMove>(&event))
        return Span{move->frame, move->until, {}};
    return std::nullopt;
}

} // namespace

LightState withEvent(const LightState& light, const LightEvent& event) {
    return {.on = event.on.value_or(light.on),
            .power = event.power.value_or(light.power),
            .tint = event.tint.value_or(light.tint)};
}

std::optional<LightEvent> changeOf(int frame, const std::string& light, const LightState& before,
                                   const LightState& after) {
    if (before == after)
        return {};
    LightEvent event{.frame = frame, .light = light};
    if (before.on != after.on)
        event.on = after.on;
    if (before.power != after.power)
        event.power = after.power;
    if (before.tint != after.tint)
        event.tint = after.tint;
    return event;
}

std::vector<LightEvent> lightChanges(int frame, std::span<const std::string> names,
                                     std::span<const LightState> before,
                                     std::span<const LightState> after) {
    std::vector<LightEvent> changes;
    for (std::size_t slot = 0; slot < names.size(); ++slot)
        if (auto change = changeOf(frame, names[slot], lightIn(before, slot), lightIn(after, slot)))
            changes.push_back(*std::move(change));
    return changes;
}

int frameOf(const TimelineEvent& event) {
    return std::visit([](const auto& e) { return e.frame; }, event);
}

std::string describe(const TimelineEvent& event) {
    if (const auto* light = std::get_if<LightEvent>(&event))
        return describeLight(*light);
    const Span span = *spanOf(event);
    const bool jumps = span.until == span.frame + 1;
    if (span.node.empty())
        return jumps ? "camera cut" : "camera moves";
    return std::string(span.node) + (jumps ? " jumps" : " moves");
}

Timeline::Timeline(int frames, std::vector<TimelineEvent> events)
    : frames_(frames), events_(std::move(events)) {
    int last = 0;
    std::map<std::string_view, int> arrived;
    for (const TimelineEvent& event : events_) {
        const int frame = frameOf(event);
        if (frame < last || frame >= frames_)
            throw std::logic_error(
                "the events of a timeline must be in order and within its frames");
        last = frame;
        if (const auto span = spanOf(event)) {
            if (span->until <= frame || frame < arrived[span->node])
                throw std::logic_error("a motion must end after it begins and before the next");
            arrived[span->node] = span->until;
        }
    }
}

bool Timeline::moves() const {
    return std::ranges::any_of(events_,
                               [](const auto& event) { return spanOf(event).has_value(); });
}

std::vector<LightState> Timeline::lightsAt(const Scene& scene, int frame) const {
    std::vector<LightState> lights(scene.lights.size());
    for (const TimelineEvent& event : events_) {
        const auto* const light = std::get_if<LightEvent>(&event);
        if (!light || light->frame > frame)
            continue;
        for (std::size_t slot = 0; slot < lights.size(); ++slot)
            if (light->light == kAllLights || light->light == scene.lights[slot].name)
                lights[slot] = withEvent(lights[slot], *light);
    }
    return lights;
}

SceneFrame Timeline::frameAt(const Scene& staged, double rate, int frame) const {
    const double seconds = frame / rate;
    return {.frame = std::uint32_t(frame),
            .seconds = seconds,
            .camera = cameraAt(staged, poseAt(staged, seconds)),
            .lights = lightsAt(staged, frame)};
}

Timeline lightTimeline(const Scene& scene, std::vector<LightEvent> events, int frames) {
    std::vector<std::string_view> known;
    for (const Light& light : scene.lights)
        known.push_back(light.name);
    for (const LightEvent& event : events)
        if (std::ranges::find(known, event.light) == known.end())
            throw UsageError(scene.name + ": " + unknownName("light", event.light, known));

    std::ranges::stable_sort(events, {}, &LightEvent::frame);
    std::map<std::string, LightState> lights;
    std::vector<TimelineEvent> changes;
    for (const LightEvent& event : events) {
        LightState& light = lights[event.light];
        const LightState before = std::exchange(light, withEvent(light, event));
        if (const auto change = changeOf(event.frame, event.light, before, light);
            change && event.frame < frames)
            changes.emplace_back(*change);
    }
    return Timeline(frames, std::move(changes));
}

std::vector<Interval> intervalsOf(const Timeline& timeline, const Scene& staged, double rate) {
    std::vector<Interval> intervals;
    SceneFrame before;
    for (int frame = 0; frame < timeline.frames(); ++frame) {
        SceneFrame now = timeline.frameAt(staged, rate, frame);
        const SceneChange changed =
            frame == 0 ? SceneChange{} : changeBetween(staged, before.input(0), now.input(0));
        if (frame == 0 || changed.any())
            intervals.push_back({.first = frame, .start = now, .changed = changed});
        intervals.back().end = frame + 1;
        before = std::move(now);
    }
    return intervals;
}

std::size_t intervalAt(const std::vector<Interval>& intervals, int frame) {
    const auto after = std::ranges::upper_bound(intervals, frame, {}, &Interval::first);
    return std::size_t(after - intervals.begin()) - 1;
}

} // namespace afterglow
