// SPDX-License-Identifier: MIT
// An experiment as the text of a file: parseExperiment() and toJson().

#include "app/base/json_reader.h"
#include "app/scenario/experiment.h"
#include "app/scenario/presets.h"
#include "renderer/base/error.h"
#include "renderer/base/json.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <limits>
#include <map>

#include <nlohmann/json.hpp>

namespace afterglow {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMostFrames = 100000;
constexpr int kMostSamples = 1 << 20;
constexpr int kMostEdge = 16384;
constexpr std::string_view kExternal = "external"; // in the place of a filter
constexpr double kMostPower = 1e6; // of lights: more would not be told from a slip of the keyboard

bool isPath(std::string_view text, std::initializer_list<std::string_view> endings) {
    return text.find('/') != text.npos ||
           std::any_of(endings.begin(), endings.end(),
                       [&](auto end) { return text.ends_with(end); });
}

glm::vec3 readPoint(const JsonReader& json) {
    return json.vector<glm::vec3>("[x, y, z]", -1e6, 1e6);
}

std::string readName(const JsonReader& json) {
    std::string name = json.text();
    if (!isPlainName(name))
        json.fail("a name of letters, digits, \"-\", \"_\" and \".\"");
    return name;
}

std::string readScene(const JsonReader& json) {
    const std::string scene = json.text();
    if (scene.empty())
        json.fail("the name of a scene or the path of a file");
    if (!isPath(scene, {".gltf", ".glb"}))
        return scene;
    return (std::filesystem::path(json.source()).parent_path() / scene).lexically_normal().string();
}

auto numberIn(double least, double most) {
    return [=](const JsonReader& json) { return json.number(least, most); };
}
auto wholeIn(std::int64_t least, std::int64_t most) {
    return [=](const JsonReader& json) { return json.wholeNumber(least, most); };
}

Signal readSignal(const JsonReader& json) {
    return allSignals()[json.choice(signalNames())];
}

Filter readFilter(const JsonReader& json) {
    std::vector<std::string_view> names;
    for (const Filter filter : allFilters())
        names.push_back(nameOf(filter));
    return allFilters()[json.choice(names)];
}

Variant readVariant(const JsonReader& json) {
    if (json.isText()) {
        try {
            return variantNamed(json.text());
        } catch (const UsageError& error) {
            json.refuse(error.what());
        }
    }
    json.expectKeys({"name", "filter", "settings", "sweep"});
    if (const JsonReader filter = json.at("filter");
        filter.isText() && filter.text() == kExternal) {
        json.expectKeys({"name", "filter"});
        return {.name = readName(json.at("name")), .filter = Filter::None, .external = true};
    }
    Variant variant{.name = readName(json.at("name")), .filter = readFilter(json.at("filter"))};
    if (const auto settings = json.find("settings"))
        for (const auto& [key, value] : settings->members())
            variant.changes.emplace_back(key, value.setting());
    if (const auto sweep = json.find("sweep")) {
        sweep->expectKeys({"variant", "key", "value"});
        variant.sweep = SweepPoint{sweep->at("variant").text(), sweep->at("key").text(),
                                   sweep->at("value").setting()};
    }
    try {
        requireMeasurable(settingsOf(variant, Signal::Both));
    } catch (const UsageError& error) {
        throw InputError(std::string(json.source()) + ": variant " + variant.name + ": " +
                         error.what());
    }
    return variant;
}

std::vector<Variant> readVariants(const JsonReader& json) {
    std::vector<Variant> variants;
    for (const JsonReader& item : json.list("a list of variants", 1, 1024)) {
        variants.push_back(readVariant(item));
        const auto same = std::ranges::find(variants, variants.back().name, &Variant::name);
        if (&*same != &variants.back())
            item.fail("each name once");
    }
    return variants;
}

LightEvent readLightEvent(const JsonReader& json, int frame) {
    json.expectKeys({"frame", "light", "on", "power", "tint"});
    LightEvent event{.frame = frame, .light = json.at("light").text()};
    if (event.light.empty())
        json.at("light").fail("the name of a light, or \"*\" for all");
    readIfThere(json, "on", event.on, &JsonReader::boolean);
    readIfThere(json, "power", event.power, numberIn(0.0, kMostPower));
    readIfThere(json, "tint", event.tint, [](const JsonReader& tint) {
        return tint.vector<glm::vec3>("[red, green, blue]", 0.0, kMostPower);
    });
    if (!event.on && !event.power && !event.tint)
        json.fail("one of \"on\", \"power\" and \"tint\"");
    return event;
}

int readUntil(const JsonReader& json, int frame, int frames) {
    const auto until = json.find("until");
    if (!until)
        return frame + 1;
    if (frame == 0)
        until->fail("no end of what is set up at frame 0");
    return int(until->wholeNumber(frame + 1, frames));
}

/// Reads an event. The key that names its target tells its kind.
TimelineEvent readEvent(const JsonReader& json, int frame, int frames) {
    if (json.find("node")) {
        json.expectKeys({"frame", "until", "node", "by", "turn"});
        NodeMotion motion{.frame = frame,
                          .until = readUntil(json, frame, frames),
                          .node = json.at("node").text()};
        const auto turn = json.find("turn");
        if (turn)
            motion.turn = float(turn->number(-179.0, 179.0)); // the shorter way round is meant
        if (!turn || json.find("by"))
            motion.by = readPoint(json.at("by"));
        return motion;
    }
    if (const auto camera = json.find("camera")) {
        json.expectKeys({"frame", "until", "camera"});
        camera->expectKeys({"eye", "target"});
        return CameraMove{.frame = frame,
                          .until = readUntil(json, frame, frames),
                          .eye = readPoint(camera->at("eye")),
                          .target = readPoint(camera->at("target"))};
    }
    if (json.find("light"))
        return readLightEvent(json, frame);
    json.fail("one of \"light\", \"node\" and \"camera\"");
}

Timeline readTimeline(const JsonReader& json) {
    const int frames = int(json.at("frames").wholeNumber(1, kMostFrames));
    std::vector<TimelineEvent> events;
    std::map<std::string, int> arrives; // by what moves; the camera has no name
    if (const auto list = json.find("timeline")) {
        for (const JsonReader& item : list->list("a list of events", 0, kMostFrames)) {
            const JsonReader at = item.at("frame");
            const int frame = int(at.wholeNumber(0, std::numeric_limits<int>::max()));
            const int earliest = events.empty() ? 0 : frameOf(events.back());
            if (frame >= frames)
                at.fail("a frame below the number of frames, " + std::to_string(frames));
            if (frame < earliest)
                at.fail("events in the order of their frames: " + std::to_string(earliest) +
                        " or later");
            const TimelineEvent event = readEvent(item, frame, frames);
            const auto moves = [&](const std::string& what, int until) {
                int& arrived = arrives[what];
                if (frame < arrived)
                    at.fail("a frame at which it has arrived: " + std::to_string(arrived) +
                            " or later");
                arrived = until;
            };
            if (const auto* motion = std::get_if<NodeMotion>(&event))
                moves(motion->node, motion->until);
            if (const auto* move = std::get_if<CameraMove>(&event))
                moves("", move->until);
            events.push_back(event);
        }
    }
    return Timeline(frames, std::move(events));
}

Json listOf(glm::vec3 v) {
    return {shortest(v.x), shortest(v.y), shortest(v.z)};
}

Json describe(const LightEvent& event) {
    Json json = {{"frame", event.frame}, {"light", event.light}};
    if (event.on)
        json["on"] = *event.on;
    if (event.power)
        json["power"] = shortest(*event.power);
    if (event.tint)
        json["tint"] = listOf(*event.tint);
    return json;
}

Json withSpan(int frame, int until) {
    Json json = {{"frame", frame}};
    if (until > frame + 1)
        json["until"] = until;
    return json;
}

Json describe(const NodeMotion& motion) {
    Json json = withSpan(motion.frame, motion.until);
    json["node"] = motion.node;
    if (motion.by != glm::vec3(0.0f) || motion.turn == 0.0f)
        json["by"] = listOf(motion.by);
    if (motion.turn != 0.0f)
        json["turn"] = shortest(motion.turn);
    return json;
}

Json describe(const CameraMove& move) {
    Json json = withSpan(move.frame, move.until);
    json["camera"] = {{"eye", listOf(move.eye)}, {"target", listOf(move.target)}};
    return json;
}

/// Returns a number as a number, a name as a name.
Json settingJson(const std::string& value) {
    double number = 0.0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    return error == std::errc() && end == value.data() + value.size() ? Json(number) : Json(value);
}

Json describe(const Variant& variant) {
    if (variant.external)
        return {{"name", variant.name}, {"filter", kExternal}};
    Json json = {{"name", variant.name}, {"filter", nameOf(variant.filter)}};
    json["settings"] = Json::object();
    for (const auto& [key, value] : variant.changes)
        json["settings"][key] = settingJson(value);
    if (variant.sweep)
        json["sweep"] = {{"variant", variant.sweep->variant},
                         {"key", variant.sweep->key},
                         {"value", settingJson(variant.sweep->value)}};
    return json;
}

} // namespace

Experiment parseExperiment(std::string_view text, std::string_view source) {
    return readExperiment(JsonDocument(text, source).root());
}

Experiment readExperiment(const JsonReader& json) {
    json.expectKeys({"name", "description", "scene", "size", "frames", "rate", "seed", "signal",
                     "animated", "variants", "timeline", "referenceSamples", "settledWindow"});

    Experiment experiment;
    experiment.name = readName(json.at("name"));
    experiment.scene = readScene(json.at("scene"));
    experiment.variants = readVariants(json.at("variants"));
    experiment.timeline = readTimeline(json);
    readIfThere(json, "description", experiment.description, &JsonReader::text);
    readIfThere(json, "size", experiment.size, [](const JsonReader& size) {
        return size.vector<glm::ivec2>("[width, height]", 1, kMostEdge);
    });
    readIfThere(json, "rate", experiment.rate, numberIn(0.001, 1000.0));
    readIfThere(json, "seed", experiment.seed, wholeIn(0, 0xffffffffll));
    readIfThere(json, "signal", experiment.signal, readSignal);
    readIfThere(json, "animated", experiment.animated, &JsonReader::boolean);
    readIfThere(json, "referenceSamples", experiment.referenceSamples, wholeIn(1, kMostSamples));
    readIfThere(json, "settledWindow", experiment.settledWindow, wholeIn(1, kMostFrames));
    return experiment;
}

std::string toJson(const Experiment& experiment) {
    Json variants = Json::array();
    for (const Variant& variant : experiment.variants)
        variants.push_back(describe(variant));
    Json timeline = Json::array();
    for (const TimelineEvent& event : experiment.timeline.events())
        timeline.push_back(std::visit([](const auto& e) { return describe(e); }, event));
    const Json json = {
        {"name", experiment.name},
        {"description", experiment.description},
        {"scene", experiment.scene},
        {"size", {experiment.size.x, experiment.size.y}},
        {"frames", experiment.frames()},
        {"rate", experiment.rate},
        {"seed", experiment.seed},
        {"signal", nameOf(experiment.signal)},
        {"animated", experiment.animated},
        {"variants", variants},
        {"timeline", timeline},
        {"referenceSamples", experiment.referenceSamples},
        {"settledWindow", experiment.settledWindow},
    };
    return jsonText(json, 4) + "\n";
}

} // namespace afterglow
