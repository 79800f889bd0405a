// SPDX-License-Identifier: MIT
#include "app/scenario/presets.h"
#include "app/workbench/tour.h"
#include "renderer/base/error.h"
#include "renderer/pipeline/aov.h"
#include "renderer/scene/load_scene.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

const Scene& sceneNamed(const std::string& name) {
    static std::map<std::string, Scene> loaded;
    const auto found = loaded.find(name);
    return found != loaded.end() ? found->second
                                 : loaded.emplace(name, loadScene(name)).first->second;
}

/// As the program does it: the stop's scene is opened, then the stop is entered.
ViewState entered(const TourStop& stop, glm::ivec2 image = {320, 180}) {
    ViewState state = startState(sceneNamed(stop.scene), Settings{});
    state.sceneName = stop.scene;
    enterStop(state, stop, image);
    return state;
}

/// A small stop; one member may be added or replaced.
std::string file(const std::string& key = "", const std::string& value = "") {
    std::map<std::string, std::string> members{
        {"title", R"("A title")"}, {"text", R"("A text.")"}, {"scene", R"("cornell")"}};
    if (!key.empty())
        members[key] = value;
    std::string text;
    for (const auto& [name, what] : members)
        if (!what.empty())
            text += (text.empty() ? "" : ",\n") + ("\"" + name + "\": " + what);
    return R"({"stops": [{)" + text + "}]}";
}

TourStop stopWith(const std::string& key, const std::string& value) {
    return parseTour(file(key, value), "small.json").at(0);
}

std::string refusalOf(std::string_view text) {
    try {
        parseTour(text, "small.json");
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

std::string refusal(const std::string& key, const std::string& value) {
    return refusalOf(file(key, value));
}

bool contains(const std::string& text, std::string_view part) {
    return text.find(part) != text.npos;
}

int sentences(std::string_view text) {
    int count = 0;
    for (std::size_t i = 0; i < text.size(); ++i)
        if ((text[i] == '.' || text[i] == '?' || text[i] == '!') &&
            (i + 1 == text.size() || text[i + 1] == ' '))
            ++count;
    return count;
}

} // namespace

TEST_CASE("the tour has eight stops, each short enough to be read beside the picture") {
    CHECK(tourStops().size() == 8);
    std::set<std::string> titles;
    for (const TourStop& stop : tourStops()) {
        CAPTURE(stop.title);
        titles.insert(stop.title);
        CHECK(stop.title.size() <= 40);
        CHECK(stop.text.size() <= 330);
        CHECK(sentences(stop.text) >= 1);
        CHECK(sentences(stop.text) <= 3);
        CHECK(std::ranges::all_of(stop.text, [](char c) { return c >= ' ' && c <= '~'; }));
    }
    CHECK(titles.size() == tourStops().size());
}

TEST_CASE("what a stop names is in its scene, and every stop shows something that happens") {
    for (const TourStop& stop : tourStops()) {
        CAPTURE(stop.title);
        const Scene& scene = sceneNamed(stop.scene);
        const auto hasLight = [&](const std::string& name) {
            return std::ranges::find(scene.lights, name, &Light::name) != scene.lights.end();
        };
        for (const std::string& light : stop.lights)
            CHECK((light == "*" || hasLight(light)));
        REQUIRE(stop.repeats);
        CHECK((stop.repeats->light.empty() || hasLight(stop.repeats->light)));
    }
}

TEST_CASE("at every stop the filters that are seen make the image that is seen") {
    for (const TourStop& stop : tourStops()) {
        CAPTURE(stop.title);
        const ViewState state = entered(stop);
        CHECK(isShown(state.panes, state.panes.active));
        if (stop.image.empty()) {
            CHECK(state.shown.kind == Shown::Kind::Picture);
            continue;
        }
        for (const std::size_t pane : shownPanes(state.panes)) {
            const auto aov = shownAov(state, pane);
            REQUIRE(aov);
            CHECK(aovs()[*aov].name == stop.image);
        }
    }
}

TEST_CASE("the filters that a stop compares differ") {
    for (const TourStop& stop : tourStops()) {
        CAPTURE(stop.title);
        const Panes panes = entered(stop).panes;
        const auto shown = shownPanes(panes);
        for (const std::size_t a : shown)
            for (const std::size_t b : shown)
                CHECK(
                    (a == b || !differencesOf(settingsOf(panes, a), settingsOf(panes, b)).empty()));
    }
}

TEST_CASE("a stop's probe lies in the picture at every size, on the same part of it") {
    for (const TourStop& stop : tourStops()) {
        CAPTURE(stop.title);
        if (!stop.probe)
            continue;
        const auto& part = *stop.probe;
        for (const glm::ivec2 size :
             {glm::ivec2(1, 1), {2, 5}, {61, 37}, {320, 180}, {1919, 1077}, {7, 900}}) {
            CAPTURE(size.x);
            const auto placed = entered(stop, size).probes[0];
            REQUIRE(placed);
            CHECK(placed->image == size);
            const glm::vec2 low(placed->probe.min), high(placed->probe.min + placed->probe.size);
            CHECK(glm::all(glm::greaterThan(high, low)));
            CHECK(glm::all(glm::greaterThanEqual(low, glm::vec2(0.0f))));
            CHECK(glm::all(glm::lessThanEqual(high, glm::vec2(size))));
            // Less than one pixel from where it was asked for.
            const glm::vec2 wantedLow = glm::vec2(part[0], part[1]) * glm::vec2(size);
            const glm::vec2 wantedHigh = glm::vec2(part[2], part[3]) * glm::vec2(size);
            CHECK(glm::all(glm::lessThan(glm::abs(low - wantedLow), glm::vec2(1.0f))));
            CHECK(glm::all(glm::lessThan(glm::abs(high - wantedHigh), glm::vec2(1.0f))));
        }
        // Before the first frame there is no size yet.
        CHECK(entered(stop, {0, 0}).probes[0]->image.x > 0);
    }
}

TEST_CASE("entering a stop undoes what a person or the stop before has changed, whatever it was") {
    for (const TourStop& stop : tourStops())
        for (const TourStop& before : tourStops()) {
            if (stop.scene != before.scene)
                continue;
            CAPTURE(stop.title);
            CAPTURE(before.title);
            const ViewState fresh = entered(stop);
            ViewState state = entered(before);
            for (int frame = 0; frame < before.repeats->every + 3; ++frame) {
                nextFrame(state.time, liveFrame(state));
                frameRendered(state.time, 0.1);
            }
            state.lights.back() = {.on = false, .power = 0.5f, .tint = {1.0f, 0.5f, 0.25f}};
            state.camera.position.x += 0.1f;
            for (ImageDisplay& display : state.displays)
                display.high *= 2.0f;
            for (Pane& pane : state.panes.all)
                pane.settings.denoiser.temporal.alpha = 0.9f;
            state.panes.frame.lighting.signal = int(Signal::AmbientOcclusion);
            state.panes.frame.display.exposure = 1.5f;
            setProbe(state, 3, {{5, 5}, {2, 2}}, {320, 180});
            toggleFreeze(state);
            state.showPresets = state.showHelp = true;

            enterStop(state, stop, {320, 180});
            CHECK(state.lights == fresh.lights);
            CHECK(state.camera == fresh.camera);
            CHECK(state.onPath == fresh.onPath);
            CHECK(state.shown == fresh.shown);
            if (state.shown.kind == Shown::Kind::Image)
                CHECK(state.displays[state.shown.index] == fresh.displays[fresh.shown.index]);
            CHECK(state.probes == fresh.probes);
            CHECK(state.inspected.has_value() == fresh.inspected.has_value());
            CHECK(state.repeated == fresh.repeated);
            CHECK(state.panes.layout == fresh.panes.layout);
            CHECK(state.panes.pair == fresh.panes.pair);
            CHECK(state.panes.active == fresh.panes.active);
            CHECK(changedPanes(state.panes, fresh.panes).empty() == false); // the exposure stays
            CHECK(state.panes.frame.display.exposure == 1.5f);
            for (std::size_t i = 0; i < kFilterStates; ++i) {
                const Settings a = settingsOf(state.panes, i), b = settingsOf(fresh.panes, i);
                CHECK(differencesOf(a, b).empty());
                CHECK(a.lighting.signal == b.lighting.signal);
                CHECK(state.panes.all[i].title == fresh.panes.all[i].title);
            }
            CHECK_FALSE(state.frozen);
            CHECK_FALSE(state.showPresets);
            CHECK_FALSE(state.showHelp);
            CHECK(state.showCurves == fresh.showCurves);
            CHECK(state.showStrip == fresh.showStrip);
            CHECK(state.showInspector == fresh.showInspector);
            CHECK_FALSE(state.time.paused);
            CHECK_FALSE(state.time.playing);
            CHECK(state.time.frame == 0);
            CHECK(state.time.resetWanted);
            CHECK(state.time.frameLimit == fresh.time.frameLimit);
        }
}

TEST_CASE("at a stop the same happens again and again, first after so many frames") {
    for (const TourStop& stop : tourStops()) {
        CAPTURE(stop.title);
        REQUIRE(stop.repeats);
        const int every = stop.repeats->every;
        ViewState state = entered(stop);
        std::vector<int> happened;
        for (int frame = 0; frame < 3 * every; ++frame) {
            const SceneFrame moment = nextFrame(state.time, liveFrame(state));
            if (!moment.marks.empty())
                happened.push_back(frame);
            if (!stop.repeats->light.empty() && frame > 0)
                CHECK(moment.step == (frame % every == 0)); // a response to be measured
            frameRendered(state.time, 0.1);
        }
        CHECK(happened == std::vector<int>{every, 2 * every});
    }
}

TEST_CASE("what a person has recorded survives a stop, and what is being recorded ends") {
    const TourStop& stop = tourStops().front();
    ViewState state = entered(stop);
    const auto render = [&] {
        nextFrame(state.time, liveFrame(state));
        frameRendered(state.time, 0.1);
    };
    markIn(state.time);
    render();
    render();
    markOut(state.time);
    REQUIRE(state.time.recorded);
    REQUIRE(state.time.playing);
    const Take take = *state.time.recorded;

    enterStop(state, stop, {320, 180});
    CHECK_FALSE(state.time.playing);
    CHECK_FALSE(state.time.restoreWanted);
    REQUIRE(state.time.recorded);
    CHECK(*state.time.recorded == take);
    CHECK(state.time.hasCheckpoint);

    render();
    markIn(state.time);
    render();
    enterStop(state, stop, {320, 180});
    CHECK_FALSE(state.time.recording);
    CHECK_FALSE(state.time.recorded); // the new record took its place before
    CHECK_FALSE(state.time.hasCheckpoint);
    CHECK_FALSE(state.time.checkpointWanted);
    render();
    markIn(state.time);
    render();
    markOut(state.time);
    CHECK(state.time.recorded->name != take.name);
}

TEST_CASE("with the inspector, the middle of the probe is pinned in the active pane") {
    TourStop stop = stopWith("probe", "[0.2, 0.4, 0.4, 0.6]");
    stop.layout = PaneLayout::TwoUp;
    stop.pair = {2, 1};
    CHECK_FALSE(entered(stop, {100, 50}).inspected);
    stop.inspector = true;
    const auto pinned = entered(stop, {100, 50}).inspected;
    REQUIRE(pinned);
    CHECK(pinned->pane == 2);
    CHECK(pinned->pixel == glm::ivec2(30, 25));
}

TEST_CASE("a pane is called like its preset only where it is that preset") {
    const TourStop stop = stopWith(
        "panes",
        R"(["exponential", {"filter": "exponential", "settings": {"alpha": 0.5}}, "svgf", "asvgf"])");
    const Panes panes = entered(stop).panes;
    CHECK(panes.all[0].title == "Fixed alpha 0.2");
    CHECK(titleOf(panes.all[1]) == titleOf(Filter::Fixed));
    CHECK(panes.all[1].settings.denoiser.temporal.alpha == 0.5f);
    CHECK(panes.all[1].settings.filter == Filter::Fixed);
    CHECK(titleOf(panes.all[2]) == "SVGF");
    CHECK(panes.all[3].settings.filter == Filter::Asvgf);
}

TEST_CASE("every member of a stop is read, and the rest has its documented value") {
    const TourStop plain = parseTour(file(), "small.json").at(0);
    CHECK(plain.title == "A title");
    CHECK(plain.text == "A text.");
    CHECK(plain.scene == "cornell");
    CHECK(plain.signal == Signal::Both);
    CHECK(plain.layout == PaneLayout::Single);
    CHECK(plain.lights == std::vector<std::string>{"*"});
    CHECK_FALSE(plain.repeats);
    CHECK(plain.image.empty());
    CHECK(plain.animated);
    CHECK(plain.frameLimit == 0);
    const ViewState still = entered(plain);
    CHECK(still.time.repeat.every == 0);
    CHECK(std::ranges::all_of(still.lights, &LightState::on));

    const ViewState state = entered(parseTour(R"({"stops": [{
        "title": "t", "text": "x", "scene": "cornell", "signal": "ao", "layout": "difference",
        "panes": ["svgf", "paper"], "pair": ["B", "A"], "gain": 8, "image": "alpha",
        "lights": ["fill"], "repeat": {"event": "dim", "light": "fill", "every": 7},
        "animated": false, "cameraPath": true, "framesPerSecond": 5,
        "probe": [0, 0, 1, 1], "curve": "history", "open": ["strip"]}]})",
                                              "small.json")
                                        .at(0));
    CHECK(state.panes.frame.lighting.signal == int(Signal::AmbientOcclusion));
    CHECK(state.panes.layout == PaneLayout::Difference);
    CHECK(state.panes.pair == std::array<std::size_t, 2>{1, 0});
    CHECK(state.panes.active == 1);
    CHECK(state.panes.gain == 8.0f);
    CHECK(state.panes.all[0].settings.filter == Filter::Svgf);
    CHECK(state.panes.all[1].title == "A-SVGF 2018, paper");
    CHECK(aovs()[state.shown.index].name == "alpha");
    for (std::size_t i = 0; i < state.lights.size(); ++i)
        CHECK(state.lights[i].on == (state.lightNames[i] == "fill"));
    CHECK(state.repeated.kind == EventKind::Dim);
    CHECK(state.lightNames[state.repeated.slot] == "fill");
    CHECK(state.time.repeat.every == 7);
    CHECK(state.repeatEvery == 7);
    CHECK_FALSE(state.time.animate);
    CHECK(state.onPath);
    CHECK(state.time.frameLimit == 5);
    CHECK(state.probes[0]->probe == Probe{{0, 0}, {320, 180}});
    CHECK(state.curve == ProbeQuantity::History);
    CHECK_FALSE(state.showCurves);
    CHECK(state.showStrip);
}

TEST_CASE("a tour that is wrong is refused with the file and the place") {
    CHECK(refusalOf(file()) == "accepted");
    CHECK(refusalOf("{") == "small.json:1: this is not JSON");
    CHECK(refusalOf("{}") == "small.json: \"stops\" is missing");
    CHECK(contains(refusalOf(R"({"stops": []})"), "small.json: stops: expected a list of stops"));
    CHECK(contains(refusalOf(R"({"stops": [{"text": "x"}]})"),
                   "small.json: stops[0]: \"title\" is missing"));
    const auto refused = [](const std::string& key, const std::string& value,
                            const std::string& place, std::string_view cause) {
        const std::string message = refusal(key, value);
        CAPTURE(message);
        CHECK(message.starts_with("small.json: stops[0]" + place + ": "));
        CHECK(contains(message, cause));
        CHECK_FALSE(contains(message, "\n"));
    };
    refused("titel", "\"x\"", "", "unknown key \"titel\"");
    refused("text", "\"\"", ".text", "found \"\"");
    refused("scene", "7", ".scene", "expected a text, found 7");
    refused("signal", "\"none\"", ".signal", "\"separate\", \"path\", \"split\" or \"bounce\"");
    refused("layout", "\"six\"", ".layout", "found \"six\"");
    refused("panes", "[]", ".panes", "a list of 1 to 4 filters");
    refused("panes", R"(["svgf", "asvfg"])", ".panes[1]", "did you mean 'asvgf'?");
    refused("panes", R"([{"filter": "nothing"}])", ".panes[0].filter", "'nothing'");
    refused("panes", R"([{"filter": "svgf", "alpha": 1}])", ".panes[0]", "unknown key \"alpha\"");
    refused("panes", R"([{"filter": "svgf", "settings": {"alpha": 2}}])",
            ".panes[0].settings.alpha", "alpha");
    refused("panes", R"([{"filter": "svgf", "settings": {"alhpa": 0.2}}])",
            ".panes[0].settings.alhpa", "did you mean 'alpha'?");
    refused("panes", R"([{"filter": "svgf", "settings": {"signal": "ao"}}])",
            ".panes[0].settings.signal", "belongs to the whole frame");
    refused("pair", R"(["A", "A"])", ".pair", "two different panes");
    refused("pair", R"(["A", "E"])", ".pair[1]", "\"D\"");
    refused("gain", "0", ".gain", "a number from 0.1 to 100");
    refused("image", "\"lamda\"", ".image", "did you mean 'lambda'?");
    refused("lights", "\"key\"", ".lights", "a list of lights");
    refused("repeat", R"({"event": "explode", "every": 9})", ".repeat.event", "\"toggle\"");
    refused("repeat", R"({"event": "toggle", "every": 9})", ".repeat", "\"light\" is missing");
    refused("repeat", R"({"event": "camera-cut", "light": "key", "every": 9})", ".repeat.light",
            "no light");
    refused("repeat", R"({"event": "camera-cut", "every": 0})", ".repeat.every", "found 0");
    refused("framesPerSecond", "7", ".framesPerSecond", "one of 0, 30, 10, 5, 2, 1");
    refused("probe", "[0, 0, 1]", ".probe", "[left, top, right, bottom]");
    refused("probe", "[0.5, 0, 0.5, 1]", ".probe", "left < right");
    refused("probe", "[0, 0, 1, 1.5]", ".probe[3]", "a number from 0 to 1");
    refused("curve", "\"lit\"", ".curve", "\"luminance\"");
    refused("open", R"(["panel"])", ".open[0]", "\"inspector\"");
    refused("animated", "1", ".animated", "true or false");
}

TEST_CASE("a stop whose light is not in the scene is a mistake that does not go unseen") {
    TourStop stop = stopWith("lights", R"(["sun"])");
    CHECK_THROWS_AS(entered(stop), std::logic_error);
    stop = stopWith("repeat", R"({"event": "toggle", "light": "sun", "every": 9})");
    CHECK_THROWS_AS(entered(stop), std::logic_error);
}
