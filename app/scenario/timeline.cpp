#include "app/scenario/timeline.h"

#include "app/scenario/frame_change.h"

#include "renderer/base/error.h"
#include "renderer/base/names.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace afterglow {
namespace {

constexpr std::string_view kAllLights = "*";

void change(LightState& state, const LightEvent& event) {
    state.on = event.on.value_or(state.on);
    state.power = event.power.value_or(state.power);
    state.tint = event.tint.value_or(state.tint);
}

std::string describeLight(const LightEvent& event) {
    std::string text = event.light == kAllLights ? "all lights" : event.light;
    if (event.on)
        text += *event.on ? " on" : " off";
    if (event.power) {
        char power[32];
        std::snprintf(power, sizeof power, " to %.4g %%", double(*event.power) * 100.0);
        text += power;
    }
    if (event.tint)
        text += " tinted";
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

const LightState& LightSettings::of(std::string_view light) const {
    const auto found = named_.find(light);
    return found == named_.end() ? others_ : found->second;
}

void LightSettings::apply(const LightEvent& event) {
    if (event.light == kAllLights) {
        change(others_, event);
        for (auto& [name, state] : named_)
            change(state, event);
    } else {
        change(named_.try_emplace(event.light, others_).first->second, event);
    }
}

bool LightSettings::operator==(const LightSettings& other) const {
    const auto agrees = [&](const auto& named) { return of(named.first) == other.of(named.first); };
    return others_ == other.others_ && std::all_of(named_.begin(), named_.end(), agrees) &&
           std::all_of(other.named_.begin(), other.named_.end(), agrees);
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

LightSettings Timeline::lightsAt(int frame) const {
    LightSettings lights;
    for (const TimelineEvent& event : events_)
        if (const auto* light = std::get_if<LightEvent>(&event); light && light->frame <= frame)
            lights.apply(*light);
    return lights;
}

std::vector<Moment> momentsOf(const Timeline& timeline, const Scene& staged, double rate) {
    const auto lightsAt = [&](int frame) {
        const LightSettings settings = timeline.lightsAt(frame);
        std::vector<LightState> lights;
        for (const Light& light : staged.lights)
            lights.push_back(settings.of(light.name));
        return lights;
    };
    const std::size_t cameraNode = staged.cameras.at(0).node;

    std::vector<Moment> moments;
    Pose before;
    for (int frame = 0; frame < timeline.frames(); ++frame) {
        Moment next{.first = frame, .end = frame + 1, .seconds = frame / rate};
        next.lights = lightsAt(frame);
        const Pose pose = poseAt(staged, next.seconds);
        if (frame > 0) {
            next.lightsChanged = lightsDiffer(staged, next.lights, moments.back().lights);
            next.worldMoved = geometryDiffers(staged, pose, before);
            next.cameraMoved = pose.worldFromNode[cameraNode] != before.worldFromNode[cameraNode];
        }
        before = pose;
        if (frame == 0 || next.lightsChanged || next.worldMoved || next.cameraMoved)
            moments.push_back(std::move(next));
        else
            moments.back().end = frame + 1;
    }
    return moments;
}

std::size_t momentAt(const std::vector<Moment>& moments, int frame) {
    const auto after = std::ranges::upper_bound(moments, frame, {}, &Moment::first);
    return std::size_t(after - moments.begin()) - 1;
}

} // namespace afterglow
