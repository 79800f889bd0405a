#include "app/experiment/experiment.h"

#include "app/experiment/embedded.h"
#include "app/experiment/json_reader.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include <nlohmann/json.hpp>

namespace afterglow {
namespace {

constexpr int kMostFrames = 100000;
constexpr int kMostSamples = 1 << 20;
constexpr int kMostEdge = 16384;
constexpr double kMostPower = 1e6; // of lights: more would not be told from a slip of the keyboard

bool isPath(std::string_view text, std::initializer_list<std::string_view> endings) {
    return text.find('/') != text.npos ||
           std::any_of(endings.begin(), endings.end(),
                       [&](auto end) { return text.ends_with(end); });
}

glm::ivec2 readSize(const JsonReader& json) {
    const std::vector<JsonReader> edges = json.list("[width, height]", 2, 2);
    return {int(edges[0].wholeNumber(1, kMostEdge)), int(edges[1].wholeNumber(1, kMostEdge))};
}

glm::vec3 readTint(const JsonReader& json) {
    const std::vector<JsonReader> channels = json.list("[red, green, blue]", 3, 3);
    glm::vec3 tint;
    for (int i = 0; i < 3; ++i)
        tint[i] = float(channels[std::size_t(i)].number(0.0, kMostPower));
    return tint;
}

std::string readName(const JsonReader& json) {
    std::string name = json.text();
    const auto isPlain = [](unsigned char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '-' || c == '_';
    };
    if (name.empty() || !std::all_of(name.begin(), name.end(), isPlain))
        json.fail("a name of letters, digits, \"-\" and \"_\"");
    return name;
}

std::string readScene(const JsonReader& json, std::string_view source) {
    const std::string scene = json.text();
    if (scene.empty())
        json.fail("the name of a scene or the path of a file");
    if (!isPath(scene, {".gltf", ".glb"}))
        return scene;
    return (std::filesystem::path(source).parent_path() / scene).lexically_normal().string();
}

Signal readSignal(const JsonReader& json) {
    constexpr std::array<Signal, 3> signals = {Signal::Shadows, Signal::AmbientOcclusion,
                                               Signal::Both};
    std::vector<std::string_view> names;
    for (const Signal signal : signals)
        names.push_back(nameOf(signal));
    return signals[json.choice(names)];
}

std::vector<std::string> readVariants(const JsonReader& json) {
    std::vector<std::string_view> names;
    for (const Filter filter : allFilters())
        names.push_back(nameOf(filter));
    std::vector<std::string> variants;
    for (const JsonReader& item : json.list("a list of filters", 1, 64)) {
        const std::string_view name = names[item.choice(names)];
        if (std::find(variants.begin(), variants.end(), name) != variants.end())
            item.fail("each filter once");
        variants.emplace_back(name);
    }
    return variants;
}

/// What an event is about is told by the key that names its target: "light" here.
LightEvent readEvent(const JsonReader& json, int frames, int earliest) {
    json.expectKeys({"frame", "light", "on", "power", "tint"});
    LightEvent event;
    const JsonReader frame = json.at("frame");
    event.frame = int(frame.wholeNumber(0, std::numeric_limits<int>::max()));
    if (event.frame >= frames)
        frame.fail("a frame below the number of frames, " + std::to_string(frames));
    if (event.frame < earliest)
        frame.fail("events in the order of their frames: " + std::to_string(earliest) +
                   " or later");
    event.light = json.at("light").text();
    if (event.light.empty())
        json.at("light").fail("the name of a light, or \"*\" for all");
    if (const auto on = json.find("on"))
        event.on = on->boolean();
    if (const auto power = json.find("power"))
        event.power = float(power->number(0.0, kMostPower));
    if (const auto tint = json.find("tint"))
        event.tint = readTint(*tint);
    if (!event.on && !event.power && !event.tint)
        json.fail("one of \"on\", \"power\" and \"tint\"");
    return event;
}

Timeline readTimeline(const JsonReader& json) {
    const int frames = int(json.at("frames").wholeNumber(1, kMostFrames));
    std::vector<LightEvent> events;
    if (const auto list = json.find("timeline")) {
        for (const JsonReader& item : list->list("a list of events", 0, kMostFrames))
            events.push_back(readEvent(item, frames, events.empty() ? 0 : events.back().frame));
    }
    return Timeline(frames, std::move(events));
}

/// The double that is written as shortly as the float: 0.1, not 0.10000000149.
double shortest(float value) {
    std::array<char, 32> text{};
    std::to_chars(text.data(), text.data() + text.size(), value);
    return std::strtod(text.data(), nullptr);
}

} // namespace

Experiment parseExperiment(std::string_view text, std::string_view source) {
    const JsonDocument document(text, source);
    const JsonReader json = document.root();
    json.expectKeys({"name", "description", "scene", "size", "frames", "rate", "seed", "signal",
                     "animated", "variants", "timeline", "referenceSamples", "settledWindow"});

    Experiment experiment;
    experiment.name = readName(json.at("name"));
    experiment.scene = readScene(json.at("scene"), source);
    experiment.variants = readVariants(json.at("variants"));
    experiment.timeline = readTimeline(json);
    if (const auto description = json.find("description"))
        experiment.description = description->text();
    if (const auto size = json.find("size"))
        experiment.size = readSize(*size);
    if (const auto rate = json.find("rate"))
        experiment.rate = rate->number(0.001, 1000.0);
    if (const auto seed = json.find("seed"))
        experiment.seed = std::uint32_t(seed->wholeNumber(0, 0xffffffffll));
    if (const auto signal = json.find("signal"))
        experiment.signal = readSignal(*signal);
    if (const auto animated = json.find("animated"))
        experiment.animated = animated->boolean();
    if (const auto samples = json.find("referenceSamples"))
        experiment.referenceSamples = int(samples->wholeNumber(1, kMostSamples));
    if (const auto window = json.find("settledWindow"))
        experiment.settledWindow = int(window->wholeNumber(1, kMostFrames));
    return experiment;
}

std::string toJson(const Experiment& experiment) {
    nlohmann::ordered_json json = {
        {"name", experiment.name},
        {"description", experiment.description},
        {"scene", experiment.scene},
        {"size", {experiment.size.x, experiment.size.y}},
        {"frames", experiment.frames()},
        {"rate", experiment.rate},
        {"seed", experiment.seed},
        {"signal", nameOf(experiment.signal)},
        {"animated", experiment.animated},
        {"variants", experiment.variants},
        {"timeline", nlohmann::ordered_json::array()},
        {"referenceSamples", experiment.referenceSamples},
        {"settledWindow", experiment.settledWindow},
    };
    for (const LightEvent& event : experiment.timeline.events()) {
        nlohmann::ordered_json item = {{"frame", event.frame}, {"light", event.light}};
        if (event.on)
            item["on"] = *event.on;
        if (event.power)
            item["power"] = shortest(*event.power);
        if (event.tint)
            item["tint"] = {shortest(event.tint->r), shortest(event.tint->g),
                            shortest(event.tint->b)};
        json["timeline"].push_back(item);
    }
    return json.dump(4) + "\n";
}

std::vector<ExperimentInfo> builtInExperiments() {
    std::vector<ExperimentInfo> infos;
    for (const EmbeddedExperiment& file : embeddedExperiments()) {
        const Experiment experiment = parseExperiment(file.text, std::string(file.name) + ".json");
        infos.push_back({experiment.name, experiment.description});
    }
    return infos;
}

Experiment loadExperiment(std::string_view nameOrPath) {
    const std::filesystem::path path(nameOrPath);
    if (isPath(nameOrPath, {".json"}))
        return parseExperiment(readFile(path), nameOrPath);

    std::vector<std::string_view> known;
    for (const EmbeddedExperiment& file : embeddedExperiments()) {
        if (file.name == nameOrPath)
            return parseExperiment(file.text, std::string(file.name) + ".json");
        known.push_back(file.name);
    }
    throw UsageError(unknownName("experiment", nameOrPath, known) +
                     "; the name of a file ends in .json");
}

} // namespace afterglow
