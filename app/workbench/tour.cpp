// SPDX-License-Identifier: MIT
#include "app/workbench/tour.h"

#include "app/base/embedded.h"
#include "app/base/json_reader.h"
#include "app/scenario/presets.h"
#include "renderer/base/error.h"
#include "renderer/pipeline/aov.h"

#include <algorithm>
#include <stdexcept>

namespace afterglow {
namespace {

constexpr std::size_t kMostStops = 99;
constexpr int kRarest = 100000;           // frames
constexpr glm::ivec2 kNominal{1280, 720}; // a probe is placed on it before there is a picture
constexpr std::string_view kAllLights = "*";

constexpr std::array<std::string_view, kEventKinds> kEventNames{
    "toggle", "dim", "recolor", "animation", "camera-cut", "camera-path"};

std::string readLine(const JsonReader& json, std::string_view wanted) {
    std::string text = json.text();
    if (text.empty())
        json.fail(wanted);
    return text;
}

// What another part of the program refuses is refused here, with the place.
template <typename Call>
auto refusedAt(const JsonReader& json, Call call) {
    try {
        return call();
    } catch (const UsageError& error) {
        json.refuse(error.what());
    }
}

Variant readPane(const JsonReader& json) {
    const JsonReader filter = json.isText() ? json : json.at("filter");
    const std::string name = filter.text();
    Variant variant = refusedAt(filter, [&] { return variantNamed(name); });
    if (json.isText())
        return variant;
    json.expectKeys({"filter", "settings"});
    for (const auto& [key, value] : json.at("settings").members()) {
        const auto field = std::ranges::find(fields(), std::string_view(key), &Field::key);
        if (field != fields().end() && field->isFrameWide())
            value.refuse("belongs to the whole frame, not to a filter");
        variant.changes.emplace_back(key, value.setting());
        refusedAt(value, [&] { return settingsOf(variant, Signal::Both); });
    }
    return variant;
}

std::size_t readPaneLetter(const JsonReader& json) {
    return json.choice(std::array<std::string_view, kFilterStates>{"A", "B", "C", "D"});
}

std::array<std::size_t, 2> readPair(const JsonReader& json) {
    const std::vector<JsonReader> panes = json.list("a list of two panes", 2, 2);
    const std::array<std::size_t, 2> pair{readPaneLetter(panes[0]), readPaneLetter(panes[1])};
    if (pair[0] == pair[1])
        json.refuse("expected two different panes");
    return pair;
}

std::vector<std::string> readLights(const JsonReader& json) {
    std::vector<std::string> lights;
    for (const JsonReader& item : json.list("a list of lights", 0, 256))
        lights.push_back(readLine(item, "the name of a light, or \"*\" for all"));
    return lights;
}

TourEvent readEvent(const JsonReader& json) {
    json.expectKeys({"event", "light", "every"});
    TourEvent event;
    event.kind = EventKind(json.at("event").choice(kEventNames));
    if (concernsLight(event.kind))
        event.light = readLine(json.at("light"), "the name of a light");
    else if (const auto light = json.find("light"))
        light->refuse("this event concerns no light");
    event.every = int(json.at("every").wholeNumber(1, kRarest));
    return event;
}

int readFrameLimit(const JsonReader& json) {
    const auto limit = int(json.wholeNumber(0, kRarest));
    if (std::ranges::find(kFrameLimits, limit) == kFrameLimits.end()) {
        std::string known;
        for (const int value : kFrameLimits)
            known += (known.empty() ? "" : ", ") + std::to_string(value);
        json.fail("one of " + known);
    }
    return limit;
}

std::array<float, 4> readProbe(const JsonReader& json) {
    constexpr std::string_view kWanted = "[left, top, right, bottom] in parts of the picture";
    const auto edges = json.vector<glm::vec4>(kWanted, 0.0, 1.0);
    const std::array<float, 4> probe{edges[0], edges[1], edges[2], edges[3]};
    if (probe[0] >= probe[2] || probe[1] >= probe[3])
        json.refuse("expected left < right and top < bottom");
    return probe;
}

void readPanels(const JsonReader& json, TourStop& stop) {
    for (const JsonReader& item : json.list("a list of panels", 0, 3)) {
        bool* const panels[] = {&stop.curves, &stop.strip, &stop.inspector};
        *panels[item.choice(std::array<std::string_view, 3>{"curves", "strip", "inspector"})] =
            true;
    }
}

TourStop readStop(const JsonReader& json) {
    json.expectKeys({"title", "text", "scene", "signal", "panes", "layout", "pair", "gain", "image",
                     "lights", "repeat", "animated", "cameraPath", "framesPerSecond", "probe",
                     "curve", "open"});
    TourStop stop;
    stop.title = readLine(json.at("title"), "a title");
    stop.text = readLine(json.at("text"), "what is said at this stop");
    stop.scene = readLine(json.at("scene"), "the name of a scene");
    readIfThere(json, "signal", stop.signal, [](const JsonReader& signal) {
        return allSignals()[signal.choice(signalNames())];
    });
    if (const auto panes = json.find("panes")) {
        std::size_t pane = 0;
        for (const JsonReader& item : panes->list("a list of 1 to 4 filters", 1, kFilterStates))
            stop.panes[pane++] = readPane(item);
    }
    readIfThere(json, "layout", stop.layout, [](const JsonReader& layout) {
        return PaneLayout(layout.choice(paneLayoutNames()));
    });
    readIfThere(json, "pair", stop.pair, readPair);
    readIfThere(json, "gain", stop.gain,
                [](const JsonReader& gain) { return gain.number(0.1, 100.0); });
    readIfThere(json, "image", stop.image, [](const JsonReader& image) {
        return refusedAt(image, [&] { return aovByName(image.text()).name; });
    });
    readIfThere(json, "lights", stop.lights, readLights);
    readIfThere(json, "repeat", stop.repeats, readEvent);
    readIfThere(json, "animated", stop.animated, &JsonReader::boolean);
    readIfThere(json, "cameraPath", stop.cameraPath, &JsonReader::boolean);
    readIfThere(json, "framesPerSecond", stop.frameLimit, readFrameLimit);
    readIfThere(json, "probe", stop.probe, readProbe);
    readIfThere(json, "curve", stop.curve, [](const JsonReader& curve) {
        std::vector<std::string_view> names;
        for (const QuantityInfo& info : quantities())
            names.push_back(info.name);
        return ProbeQuantity(curve.choice(names));
    });
    if (const auto open = json.find("open"))
        readPanels(*open, stop);
    return stop;
}

// "Fixed alpha 0.2" would be a lie over another alpha: only an unchanged preset has its title.
std::string paneTitle(const Variant& variant) {
    const auto preset = std::ranges::find(presets(), variant.name, &Preset::name);
    return preset != presets().end() && preset->variant == variant ? preset->title : "";
}

Panes panesOf(const TourStop& stop, const DisplaySettings& display) {
    Settings settings;
    settings.lighting.signal = int(stop.signal);
    settings.display = display;
    Panes panes = startPanes(settings);
    for (std::size_t i = 0; i < panes.all.size(); ++i)
        if (const auto& variant = stop.panes[i])
            setPane(panes, i, paneTitle(*variant), settingsOf(*variant, stop.signal));
    panes.layout = stop.layout;
    panes.pair = stop.pair;
    panes.gain = stop.gain;
    panes.active = stop.layout == PaneLayout::Single ? 0 : shownPanes(panes).front();
    return panes;
}

std::size_t slotOf(const ViewState& state, const std::string& light) {
    const auto found = std::ranges::find(state.lightNames, light);
    if (found == state.lightNames.end())
        throw std::logic_error("a stop of the tour needs the light '" + light +
                               "', which is not in " + state.sceneName);
    return std::size_t(found - state.lightNames.begin());
}

void setLights(ViewState& state, const std::vector<std::string>& on) {
    state.lights.assign(state.lightNames.size(), LightState{.on = false});
    for (const std::string& name : on) {
        if (name != kAllLights)
            state.lights[slotOf(state, name)].on = true;
        else
            for (LightState& light : state.lights)
                light.on = true;
    }
}

// From frame 0 as a person sees it: nothing paused, no take, and what was recorded is kept.
void startTime(ViewState& state, const TourStop& stop) {
    Transport& time = state.time;
    Transport fresh{.frameLimit = stop.frameLimit,
                    .animate = stop.animated,
                    .timeStep = time.timeStep,
                    .recorded = std::move(time.recorded),
                    .takesRecorded = time.takesRecorded};
    fresh.hasCheckpoint = time.hasCheckpoint && fresh.recorded.has_value();
    fresh.resetWanted = true;
    time = std::move(fresh);
    if (!stop.repeats)
        return;
    const TourEvent& event = *stop.repeats;
    state.repeated = {event.kind, event.light.empty() ? 0 : slotOf(state, event.light)};
    state.repeatEvery = event.every;
    time.repeat = {.every = event.every, .first = std::uint32_t(event.every)};
}

Probe probeIn(const std::array<float, 4>& parts, glm::ivec2 image) {
    const glm::vec2 size(image);
    const glm::ivec2 first(glm::floor(glm::vec2(parts[0], parts[1]) * size));
    const glm::ivec2 last(glm::ceil(glm::vec2(parts[2], parts[3]) * size) - 1.0f);
    return probeBetween(first, glm::max(first, last), image);
}

void showImage(ViewState& state, const std::string& name) {
    if (name.empty())
        return show(state, Shown::Kind::Picture);
    const auto index = std::size_t(&aovByName(name) - aovs().data());
    show(state, Shown::Kind::Image, index);
    state.displays.at(index) = imageDisplays(state.extent).at(index); // its range may have been set
}

} // namespace

std::vector<TourStop> parseTour(std::string_view text, std::string_view source) {
    const JsonDocument document(text, source);
    const JsonReader json = document.root();
    json.expectKeys({"stops"});
    std::vector<TourStop> stops;
    for (const JsonReader& item : json.at("stops").list("a list of stops", 1, kMostStops))
        stops.push_back(readStop(item));
    return stops;
}

const std::vector<TourStop>& tourStops() {
    static const std::vector<TourStop> stops = [] {
        std::vector<TourStop> all;
        for (const EmbeddedFile& file : embeddedTour())
            for (TourStop& stop : parseTour(file.bytes, file.name))
                all.push_back(std::move(stop));
        return all;
    }();
    return stops;
}

void enterStop(ViewState& state, const TourStop& stop, glm::ivec2 image) {
    if (image.x < 1 || image.y < 1)
        image = kNominal;
    setLights(state, stop.lights);
    startTime(state, stop);
    state.panes = panesOf(stop, state.panes.frame.display);
    showImage(state, stop.image);

    goHome(state);
    state.onPath = stop.cameraPath;
    state.pathSeconds = 0.0;
    state.cutPending = false;
    state.marks.clear();

    clearProbes(state);
    state.curve = stop.curve;
    state.inspected.reset();
    if (stop.probe) {
        const Probe probe = probeIn(*stop.probe, image);
        setProbe(state, 0, probe, image);
        if (stop.inspector)
            state.inspected = PanePixel{state.panes.active, probe.min + probe.size / 2};
    }

    state.frozen = false;
    state.showCurves = stop.curves;
    state.showStrip = stop.strip;
    state.showInspector = stop.inspector;
    state.showPasses = state.showPresets = state.showHelp = false;
}

} // namespace afterglow
