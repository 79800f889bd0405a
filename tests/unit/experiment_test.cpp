// SPDX-License-Identifier: MIT
#include "app/base/embedded.h"
#include "app/scenario/experiment.h"
#include "app/scenario/run_plan.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/image/color.h"
#include "renderer/scene/procedural.h"
#include "tests/support/source_dir.h"

#include <filesystem>
#include <string>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

/// A small experiment; each member may be replaced, or taken out by an empty text.
std::string file(std::string_view key = "", std::string_view value = "") {
    const std::pair<std::string_view, std::string_view> members[] = {
        {"name", R"("small")"},
        {"scene", R"("cornell")"},
        {"frames", "20"},
        {"variants", R"(["svgf", "asvgf"])"},
        {"timeline", R"([{ "frame": 4, "light": "key", "on": false }])"}};
    std::string text = "{";
    bool placed = false;
    const auto add = [&](std::string_view name, std::string_view what) {
        if (!what.empty())
            text += (text.size() > 1 ? ",\n \"" : "\n \"") + std::string(name) +
                    "\": " + std::string(what);
    };
    for (const auto& [name, standard] : members) {
        add(name, name == key ? value : standard);
        placed = placed || name == key;
    }
    if (!placed)
        add(key, value);
    return text + "\n}\n";
}

std::string refusalOf(std::string_view text) {
    try {
        parseExperiment(text, "small.json");
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

std::string refusal(std::string_view key, std::string_view value) {
    return refusalOf(file(key, value));
}

/// How the experiment sets a light of the scene "cornell": "key" or "fill".
LightState lightAt(const Experiment& experiment, int frame, std::string_view light) {
    return experiment.timeline.lightsAt(makeProceduralScene("cornell"), frame)
        .at(light == "key" ? 0 : 1);
}

} // namespace

TEST_CASE("an experiment says what its file says, and the rest has its documented value") {
    const Experiment e = parseExperiment(file(), "small.json");
    CHECK(e.name == "small");
    CHECK(e.description.empty());
    CHECK(e.scene == "cornell");
    CHECK(e.size == glm::ivec2(320));
    CHECK(e.frames() == 20);
    CHECK(e.rate == 60.0);
    CHECK(e.seed == 1);
    CHECK(e.signal == Signal::Both);
    CHECK_FALSE(e.animated);
    CHECK(e.variants == std::vector{variantOf(Filter::Svgf), variantOf(Filter::Asvgf)});
    CHECK(e.referenceSamples == 1024);
    CHECK(e.settledWindow == 16);
    CHECK(e.seconds(30) == 0.5);
    REQUIRE(e.timeline.events().size() == 1);
    CHECK(lightAt(e, 3, "key").on);
    CHECK_FALSE(lightAt(e, 4, "key").on);
}

TEST_CASE("every member of an experiment is read, and survives being written") {
    const std::string text = R"({
        "name": "all-of_it2", "description": "Says \"all\".", "scene": "hall", "size": [61, 37],
        "frames": 1e2, "rate": 23.976, "seed": 4294967295, "signal": "shadows", "animated": true,
        "variants": ["svgf", { "name": "quick-0.5", "filter": "asvgf",
            "settings": { "alpha": 0.5, "lambdaFetch": "bilinear" },
            "sweep": { "variant": "asvgf", "key": "alpha", "value": 0.5 } }], "referenceSamples": 16, "settledWindow": 5,
        "timeline": [ { "frame": 0, "light": "*", "on": false },
                      { "frame": 7, "light": "key", "power": 0.7, "tint": [1, 0.25, 0] },
                      { "frame": 7, "light": "fill", "on": true },
                      { "frame": 8, "until": 12, "node": "mover", "by": [1, -2.5, 0] },
                      { "frame": 9, "camera": { "eye": [1, 2, 3], "target": [0, 0.1, 0] } } ] })";
    const Experiment e = parseExperiment(text, "all.json");
    const auto check = [](const Experiment& x) {
        CHECK(x.name == "all-of_it2");
        CHECK(x.description == "Says \"all\".");
        CHECK(x.scene == "hall");
        CHECK(x.size == glm::ivec2(61, 37));
        CHECK(x.frames() == 100);
        CHECK(x.rate == 23.976);
        CHECK(x.seed == 4294967295u);
        CHECK(x.signal == Signal::Shadows);
        CHECK(x.animated);
        REQUIRE(x.variants.size() == 2);
        CHECK(x.variants[0] == variantOf(Filter::Svgf));
        CHECK(x.variants[1].name == "quick-0.5");
        CHECK(x.variants[1].sweep == SweepPoint{"asvgf", "alpha", "0.5"});
        const Settings settings = settingsOf(x.variants[1], x.signal);
        CHECK(settings.filter == Filter::Asvgf);
        CHECK(settings.denoiser.temporal.alpha == 0.5f);
        CHECK(settings.denoiser.temporal.lambdaFetch == gpu::kLambdaBilinear);
        CHECK(settings.lighting.signal == int(Signal::Shadows));
        CHECK(x.referenceSamples == 16);
        CHECK(x.settledWindow == 5);
        REQUIRE(x.timeline.events().size() == 5);
        CHECK(x.timeline.events()[3] ==
              TimelineEvent(
                  NodeMotion{.frame = 8, .until = 12, .node = "mover", .by = {1.0f, -2.5f, 0.0f}}));
        CHECK(
            x.timeline.events()[4] ==
            TimelineEvent(CameraMove{
                .frame = 9, .until = 10, .eye = {1.0f, 2.0f, 3.0f}, .target = {0.0f, 0.1f, 0.0f}}));
        CHECK(lightAt(x, 7, "key") ==
              LightState{.on = false, .power = 0.7f, .tint = {1.0f, 0.25f, 0.0f}});
        CHECK(lightAt(x, 7, "fill").on);
    };
    check(e);
    const Experiment back = parseExperiment(toJson(e), "again.json");
    check(back);
    CHECK(back.timeline.events() == e.timeline.events());
    CHECK(toJson(back) == toJson(e));
    CHECK(toJson(e).find("\"power\": 0.7,") != std::string::npos); // as short as it was
}

TEST_CASE("a scene that is a file is found beside its experiment") {
    const auto sceneOf = [](std::string_view scene, std::string_view source) {
        return parseExperiment(file("scene", scene), source).scene;
    };
    CHECK(sceneOf(R"("room.glb")", "/tests/a/small.json") == "/tests/a/room.glb");
    CHECK(sceneOf(R"("../room.gltf")", "/tests/a/small.json") == "/tests/room.gltf");
    CHECK(sceneOf(R"("/rooms/room.gltf")", "/tests/a/small.json") == "/rooms/room.gltf");
    CHECK(sceneOf(R"("room.gltf")", "small.json") == "room.gltf");
    CHECK(sceneOf(R"("hall")", "/tests/a/small.json") == "hall");
}

TEST_CASE("a mistake in an experiment is named by file and place, with what was wanted and found") {
    CHECK(refusal("timeline", R"([{ "frame": "x", "light": "key", "on": false }])") ==
          "small.json: timeline[0].frame: expected a whole number >= 0, found \"x\"");
    CHECK(refusal("timeline", R"([{ "frame": -1, "light": "key", "on": false }])") ==
          "small.json: timeline[0].frame: expected a whole number >= 0, found -1");
    CHECK(refusal("timeline", R"([{ "frame": 1.5, "light": "key", "on": false }])") ==
          "small.json: timeline[0].frame: expected a whole number >= 0, found 1.5");
    CHECK(
        refusal("timeline", R"([{ "frame": 20, "light": "key", "on": false }])") ==
        "small.json: timeline[0].frame: expected a frame below the number of frames, 20, found 20");
    CHECK(
        refusal("timeline", R"([{ "frame": 9, "light": "a", "on": false },
                                  { "frame": 8, "light": "b", "on": false }])") ==
        "small.json: timeline[1].frame: expected events in the order of their frames: 9 or later, "
        "found 8");
    CHECK(
        refusal("timeline", R"([{ "frame": 1, "light": "key" }])") ==
        "small.json: timeline[0]: expected one of \"on\", \"power\" and \"tint\", found an object");
    CHECK(refusal("timeline", R"([{ "frame": 1, "on": true }])") ==
          "small.json: timeline[0]: expected one of \"light\", \"node\" and \"camera\", found an "
          "object");
    CHECK(refusal("timeline", R"([{ "frame": 1, "light": "", "on": true }])") ==
          "small.json: timeline[0].light: expected the name of a light, or \"*\" for all, found "
          "\"\"");
    CHECK(refusal("timeline", R"([{ "frame": 1, "light": "key", "on": 0 }])") ==
          "small.json: timeline[0].on: expected true or false, found 0");
    CHECK(refusal("timeline", R"([{ "frame": 1, "light": "key", "power": -2 }])") ==
          "small.json: timeline[0].power: expected a number from 0 to 1e+06, found -2");
    CHECK(refusal("timeline", R"([{ "frame": 1, "light": "key", "tint": [1, 1] }])") ==
          "small.json: timeline[0].tint: expected [red, green, blue], found a list of 2");
    CHECK(refusal("timeline", R"([{ "frame": 1, "light": "key", "tint": [1, null, 1] }])") ==
          "small.json: timeline[0].tint[1]: expected a number from 0 to 1e+06, found null");
    CHECK(refusal("timeline", R"([{ "frame": 1, "camera": "main" }])") ==
          "small.json: timeline[0].camera: expected an object, found \"main\"");
    CHECK(refusal("timeline", R"([{ "frame": 1, "light": "key", "by": [0, 0, 0] }])")
              .starts_with("small.json: timeline[0]: unknown key \"by\"; known are \"frame\""));
    CHECK(refusal("timeline", R"([{ "frame": 1, "node": "a", "by": [0, 0] }])") ==
          "small.json: timeline[0].by: expected [x, y, z], found a list of 2");
    CHECK(refusal("timeline", R"([{ "frame": 3, "until": 3, "node": "a", "by": [0, 0, 0] }])") ==
          "small.json: timeline[0].until: expected a whole number from 4 to 20, found 3");
    CHECK(refusal("timeline", R"([{ "frame": 0, "until": 3, "node": "a", "by": [0, 0, 0] }])") ==
          "small.json: timeline[0].until: expected no end of what is set up at frame 0, found 3");
    CHECK(refusal("timeline", R"([{ "frame": 1, "until": 9, "node": "a", "by": [0, 0, 0] },
                                  { "frame": 8, "node": "a", "by": [0, 0, 0] }])") ==
          "small.json: timeline[1].frame: expected a frame at which it has arrived: 9 or later, "
          "found 8");
    CHECK(refusal("timeline", "7") == "small.json: timeline: expected a list of events, found 7");
    CHECK(refusal("timeline", "[7]") == "small.json: timeline[0]: expected an object, found 7");

    CHECK(refusal("name", "") == "small.json: \"name\" is missing");
    CHECK(refusal("name", R"("../up")") == "small.json: name: expected a name of letters, digits, "
                                           "\"-\", \"_\" and \".\", found \"../up\"");
    CHECK(refusal("scene", "3") == "small.json: scene: expected a text, found 3");
    CHECK(refusal("scene", R"("")") ==
          "small.json: scene: expected the name of a scene or the path of a file, found \"\"");
    CHECK(refusal("frames", "0") ==
          "small.json: frames: expected a whole number from 1 to 100000, found 0");
    CHECK(refusal("size", "[640]") ==
          "small.json: size: expected [width, height], found a list of 1");
    CHECK(refusal("size", "[640, 1e9]") ==
          "small.json: size[1]: expected a whole number from 1 to 16384, found 1000000000.0");
    CHECK(refusal("rate", "0") ==
          "small.json: rate: expected a number from 0.001 to 1000, found 0");
    CHECK(refusal("seed", "4294967296") ==
          "small.json: seed: expected a whole number >= 0, found 4294967296");
    CHECK(refusal("signal", R"("light")") ==
          "small.json: signal: expected \"shadows\", \"ao\", \"both\", \"separate\", \"path\", "
          "\"split\" or \"bounce\", found \"light\"");
    CHECK(refusal("variants", "[]") ==
          "small.json: variants: expected a list of variants, found a list of 0");
    CHECK(refusal("variants", R"(["svgf", "svgf"])") ==
          "small.json: variants[1]: expected each name once, found \"svgf\"");
    CHECK(
        refusal("variants", R"(["svgf", "a-svgf"])")
            .starts_with("small.json: variants[1]: no filter named 'a-svgf'; did you mean 'asvgf'? "
                         "(known: none, fixed"));
    CHECK(refusal("variants", R"([{ "name": "x", "filter": "a-svgf" }])")
              .starts_with("small.json: variants[0].filter: expected \"none\", \"fixed\""));
    CHECK(
        refusal("variants", R"([{ "name": "x", "filter": "svgf", "settings": { "alpha": 7 } }])") ==
        "small.json: variant x: setting 'alpha' is in [0.005, 1], not 7");
    for (const char* setting : {R"("antiAliasing": "taa")", R"("autoExposure": "on")"})
        CHECK(refusal("variants", R"([{ "name": "x", "filter": "svgf", "settings": { )" +
                                      std::string(setting) + " } }]")
                  .starts_with("small.json: variant x: an experiment measures "));
    CHECK(refusal("animated", R"("yes")") ==
          "small.json: animated: expected true or false, found \"yes\"");
    CHECK(refusal("description", "[[]]") ==
          "small.json: description: expected a text, found a list of 1");
    CHECK(refusal("referenceSamples", "0") ==
          "small.json: referenceSamples: expected a whole number from 1 to 1048576, found 0");
    CHECK(refusal("settledWindow", "{}") == "small.json: settledWindow: expected a whole number "
                                            "from 1 to 100000, found an empty object");
    CHECK(refusal("lights", "[]")
              .starts_with("small.json: unknown key \"lights\"; known are \"name\""));
}

TEST_CASE("what is not JSON is refused by its line") {
    CHECK(refusalOf("") == "small.json:1: this is not JSON");
    CHECK(refusalOf("{\n \"name\": \"a\",\n \"frames\": }\n") == "small.json:3: this is not JSON");
    CHECK(refusalOf("[1, 2]") == "small.json: expected an object, found a list of 2");
    CHECK(refusalOf("{ \"frames\": 1e999 }") == "small.json: a number is too large");
    CHECK(refusalOf("{ \"frames\": 4, \"frames\": 5 }") ==
          "small.json: the key \"frames\" occurs twice");
    CHECK(refusalOf("{ \"name\": \"\xff\" }") == "small.json:1: this is not JSON");
    CHECK(refusalOf(std::string(100000, '[')) == "small.json:1: this is not JSON");
    // Every beginning of a good file is refused, and none does harm.
    const std::string whole = file();
    for (std::size_t length = 0; length + 2 < whole.size(); ++length)
        CHECK(refusalOf(whole.substr(0, length)).starts_with("small.json:"));
}

TEST_CASE("the experiments in the program are the files of assets/experiments") {
    const std::filesystem::path folder = sourceDir() / "assets/experiments";
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().stem().string();
        CAPTURE(name);
        ++files;
        CHECK(loadExperiment(name).name == name);
        CHECK(toJson(loadExperiment(name)) == toJson(loadExperiment(entry.path().string())));
    }
    CHECK(files == embeddedExperiments().size());
    const std::vector<ExperimentInfo> infos = builtInExperiments();
    REQUIRE(infos.size() == files);
    for (std::size_t i = 0; i < infos.size(); ++i) {
        CHECK_FALSE(infos[i].description.empty());
        if (i > 0)
            CHECK(infos[i - 1].name < infos[i].name);
    }
}

TEST_CASE("the lag experiments change one light, in the middle, and nothing else") {
    for (const std::string name :
         {"light-off", "light-on", "light-dim", "fill-light", "light-color"}) {
        CAPTURE(name);
        const Experiment e = loadExperiment(name);
        const RunPlan plan = stagedRun(e).plan;
        REQUIRE(plan.intervals.size() == 2);
        REQUIRE(plan.events.size() == 1);
        CHECK(plan.intervals[1].isStep());
        CHECK(plan.intervals[1].first == e.frames() / 2);
        for (const Interval& interval : plan.intervals) {
            CHECK(interval.start.lights[1].on == (name == "fill-light" || name == "light-color"));
            CHECK(interval.frames() >= 2 * e.settledWindow);
        }
        CHECK(plan.intervals[0].start.lights[0].on == (name != "light-on"));
        CHECK(plan.intervals[1].start.lights[0].on ==
              (name != "light-off" && name != "fill-light"));
        CHECK(e.signal == (name.ends_with("color") || name.starts_with("fill") ? Signal::Both
                                                                               : Signal::Shadows));
        // Settled values are taken while there is light.
        CHECK(plan.settled.end == (name == "light-on" ? e.frames() : e.frames() / 2));
    }
    CHECK(stagedRun(loadExperiment("static")).plan.intervals.size() == 1);
}

TEST_CASE("the color experiment changes the key light's color and not its luminance") {
    const StagedRun run = stagedRun(loadExperiment("light-color"));
    const Instance& lamp = run.scene.instances[run.scene.lights[0].instances[0]];
    const glm::vec3 emission = run.scene.materials[lamp.material].emission;
    const glm::vec3 before = emission * run.plan.intervals[0].start.lights[0].scale();
    const glm::vec3 after = emission * run.plan.intervals[1].start.lights[0].scale();
    CHECK(luminance(after) == doctest::Approx(luminance(before)).epsilon(1e-5));
    CHECK(glm::length(after - before) > 0.5f * glm::length(before));
}

TEST_CASE("what moves in the suite stands still before and long enough after") {
    for (const std::string name : {"light-move", "object-move", "camera-pan", "camera-cut"}) {
        CAPTURE(name);
        const Experiment e = loadExperiment(name);
        const RunPlan plan = stagedRun(e).plan;
        REQUIRE(plan.events.size() == 1);
        const RunEvent& event = plan.events[0];
        CHECK(event.kind == RunEvent::Kind::Motion);
        CHECK(plan.settled.end == event.change.first);
        CHECK(plan.settled.frames() == e.settledWindow);
        CHECK(event.end == e.frames());
        CHECK(event.end - event.change.end > e.settledWindow);
        const Interval& moving = plan.intervals[1];
        CHECK_FALSE(moving.changed.lights);
        CHECK(moving.changed.camera == name.starts_with("camera"));
        CHECK(moving.changed.world == name.ends_with("-move"));
    }
}

TEST_CASE(
    "an unknown experiment is answered with the nearest known one, a lost file with its path") {
    const auto answer = [](std::string_view name) -> std::string {
        try {
            loadExperiment(name);
        } catch (const UsageError& error) {
            return error.what();
        }
        return "found";
    };
    CHECK(answer("lightoff")
              .starts_with("no experiment named 'lightoff'; did you mean 'light-off'? (known: "));
    CHECK(answer("statik").find("did you mean 'static'?") != std::string::npos);
    CHECK(answer("fil-ligth").find("did you mean 'fill-light'?") != std::string::npos);
    CHECK(answer("xyzzy").starts_with("no experiment named 'xyzzy' (known: bounce-off, "));
    CHECK(answer("light-on") == "found");
    CHECK_THROWS_AS(loadExperiment("no/such/experiment"), InputError);
    CHECK_THROWS_AS(loadExperiment("static.json.json"), InputError);
    CHECK_THROWS_AS(loadExperiment("/"), InputError);
}
