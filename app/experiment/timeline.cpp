#include "app/experiment/timeline.h"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace afterglow {
namespace {

constexpr std::string_view kAllLights = "*";

void change(LightState& state, const LightEvent& event) {
    state.on = event.on.value_or(state.on);
    state.power = event.power.value_or(state.power);
    state.tint = event.tint.value_or(state.tint);
}

} // namespace

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

Timeline::Timeline(int frames, std::vector<LightEvent> events)
    : frames_(frames), events_(std::move(events)) {
    int last = 0;
    for (const LightEvent& event : events_) {
        if (event.frame < last || event.frame >= frames_)
            throw std::logic_error(
                "the events of a timeline must be in order and within its frames");
        last = event.frame;
    }
}

std::vector<std::string> Timeline::lightNames() const {
    std::set<std::string> names;
    for (const LightEvent& event : events_)
        names.insert(event.light);
    names.erase(std::string(kAllLights));
    return {names.begin(), names.end()};
}

LightSettings Timeline::lightsAt(int frame) const {
    LightSettings lights;
    for (const LightEvent& event : events_) {
        if (event.frame <= frame)
            lights.apply(event);
    }
    return lights;
}

std::vector<Segment> Timeline::segments() const {
    std::vector<Segment> segments;
    if (frames_ > 0)
        segments.push_back({0, frames_, lightsAt(0)});
    for (const LightEvent& event : events_) {
        const LightSettings lights = lightsAt(event.frame);
        if (lights == segments.back().lights)
            continue;
        segments.back().end = event.frame;
        segments.push_back({event.frame, frames_, lights});
    }
    return segments;
}

} // namespace afterglow
