// SPDX-License-Identifier: MIT
#include "app/measure/run_outline.h"

#include <array>

#include <nlohmann/json.hpp>

namespace afterglow {
namespace {

constexpr std::array<std::string_view, 2> kKinds{"step", "motion"}; // by RunEvent::Kind
constexpr std::size_t kMostItems = 1000000;

std::vector<int> framesIn(const JsonReader& json, int frames) {
    std::vector<int> rising;
    for (const JsonReader& frame : json.list("a list of frames", 0, kMostItems))
        rising.push_back(
            int(frame.wholeNumber(rising.empty() ? 0 : rising.back() + 1, frames - 1)));
    return rising;
}

} // namespace

RunOutline outlineOf(const RunPlan& plan) {
    RunOutline outline{.events = plan.events, .settled = plan.settled, .pictures = plan.pictures};
    for (const Interval& interval : plan.intervals) {
        outline.references.push_back({interval.first, interval.end});
        if (interval.first > 0 && interval.changed.relights())
            outline.changes.push_back(interval.first);
    }
    return outline;
}

void writeOutline(const RunOutline& outline, nlohmann::ordered_json& json) {
    json["settled_window"] = {outline.settled.first, outline.settled.end};
    json["pictures"] = outline.pictures;
    json["events"] = nlohmann::ordered_json::array();
    for (const RunEvent& event : outline.events)
        json["events"].push_back({{"frame", event.change.first},
                                  {"end", event.change.end},
                                  {"kind", kKinds[std::size_t(event.kind)]},
                                  {"text", event.text}});
    json["changing_frames"] = outline.changes;
}

RunOutline readOutline(const JsonReader& json, int frames) {
    const auto settled =
        json.at("settled_window").vector<glm::ivec2>("the first frame and the end", 0, frames);
    RunOutline outline{.settled = {settled[0], settled[1]},
                       .pictures = framesIn(json.at("pictures"), frames),
                       .changes = framesIn(json.at("changing_frames"), frames)};
    for (const JsonReader& event : json.at("events").list("a list of events", 0, kMostItems)) {
        const int first = int(event.at("frame").wholeNumber(1, frames - 1));
        if (!outline.events.empty())
            outline.events.back().end = first;
        outline.events.push_back(
            {.kind = RunEvent::Kind(event.at("kind").choice(kKinds)),
             .change = {first, int(event.at("end").wholeNumber(first + 1, frames))},
             .end = frames,
             .text = event.at("text").text()});
    }
    for (const JsonReader& one : json.at("references").list("a list", 0, kMostItems)) {
        const int first = int(one.at("first").wholeNumber(0, frames - 1));
        outline.references.push_back({first, int(one.at("end").wholeNumber(first + 1, frames))});
    }
    return outline;
}

} // namespace afterglow
