// SPDX-License-Identifier: MIT
#include "app/scenario/take_experiment.h"
#include "app/workbench/transport.h"
#include "renderer/base/error.h"
#include "renderer/scene/load_scene.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

Experiment baseFor(const std::string& scene) {
    return {.name = "take-1",
            .description = "A record",
            .scene = scene,
            .size = {61, 37},
            .seed = 7,
            .variants = {variantOf(Filter::Svgf), variantOf(Filter::Asvgf)},
            .timeline = {}};
}

/// A take at rest in a scene, seen by its first camera, at a rate from time 0 on.
Take restingTake(const Scene& scene, int frames, double rate = 60.0) {
    Take take{.name = "take-1"};
    for (int i = 0; i < frames; ++i)
        take.frames.push_back({.seconds = i / rate,
                               .camera = cameraAt(scene, poseAt(scene, 0.0)),
                               .lights = std::vector<LightState>(scene.lights.size())});
    return take;
}

/// From that frame on; marked as the window does.
void startAt(Take& take, std::uint32_t first) {
    for (SceneFrame& frame : take.frames)
        frame.frame = first++;
}

void change(Take& take, std::size_t frame, const std::function<void(SceneFrame&)>& how,
            const std::string& mark, bool step) {
    for (std::size_t i = frame; i < take.frames.size(); ++i)
        how(take.frames[i]);
    take.frames[frame].marks.push_back(mark);
    take.frames[frame].step = step;
}

Take throughText(const Take& take, const std::string& sceneName, int leadIn = 0) {
    const std::string text = experimentText(take, loadScene(sceneName), baseFor(sceneName), leadIn);
    const Experiment experiment = parseExperiment(text, "take-1.json");
    CHECK(experiment.size == glm::ivec2(61, 37));
    CHECK(experiment.seed == 7);
    CHECK(experiment.variants.size() == 2);
    return takeOf(experiment, stagedRun(experiment));
}

/// The largest difference of a place (meters) or of an axis.
float apart(const Camera& a, const Camera& b) {
    float most = glm::length(a.position - b.position);
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 unit(0.0f);
        unit[axis] = 1.0f;
        most = std::max(most, glm::length(a.orientation * unit - b.orientation * unit));
    }
    return most;
}

void checkSame(const Take& take, const Take& expected, bool marks = true) {
    REQUIRE(take.frames.size() == expected.frames.size());
    for (std::size_t i = 0; i < take.frames.size(); ++i) {
        CAPTURE(i);
        const SceneFrame &was = expected.frames[i], &is = take.frames[i];
        CHECK(is.seconds == was.seconds);
        CHECK(is.lights == was.lights);
        CHECK(is.step == was.step);
        CHECK(apart(is.camera, was.camera) < 1e-4f);
        CHECK(is.camera.lens.verticalFov == was.camera.lens.verticalFov);
        if (marks)
            CHECK(is.marks.empty() == was.marks.empty());
    }
}

std::string refusal(const Take& take, const Scene& scene, const Experiment& base) {
    try {
        experimentText(take, scene, base);
    } catch (const Error& error) {
        return error.what();
    }
    return "none";
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != text.npos;
}

} // namespace

TEST_CASE("a take of an experiment has the lights, times, steps and names of its events") {
    const Experiment experiment = parseExperiment(R"({
        "name": "both", "scene": "cornell", "frames": 40, "rate": 24, "variants": ["asvgf"],
        "timeline": [{"frame": 0, "light": "fill", "power": 0.5},
                     {"frame": 10, "light": "key", "on": false},
                     {"frame": 20, "light": "key", "on": true},
                     {"frame": 20, "light": "fill", "power": 2},
                     {"frame": 30, "until": 35, "camera": {"eye": [0, 0.3, 1], "target": [0, 0, 0]}}]})",
                                                  "both.json");
    const Take take = takeOf(experiment, stagedRun(experiment));
    CHECK(take.name == "both");
    REQUIRE(take.frames.size() == 40);
    for (std::size_t i = 0; i < 40; ++i) {
        const SceneFrame& frame = take.frames[i];
        CHECK(frame.frame == i);
        CHECK(frame.seconds == double(i) / 24.0);
        CHECK(frame.lights[0].on == (i < 10 || i >= 20));
        CHECK(frame.lights[1].power == (i < 20 ? 0.5f : 2.0f));
        CHECK(frame.step == (i == 10 || i == 20));
        CHECK((frame.camera == take.frames[0].camera) == (i < 30));
        CHECK(frame.marks.empty() == (i != 10 && i != 20 && i != 30));
    }
    CHECK(take.frames[10].marks == std::vector<std::string>{"key off"});
    CHECK(take.frames[20].marks == std::vector<std::string>{"key on", "fill to 200 %"});
    CHECK(take.frames[30].marks == std::vector<std::string>{"camera moves"});
    CHECK(apart(take.frames[34].camera, lookAt({0, 0.3f, 1}, {0, 0, 0})) < 1e-5f);
}

TEST_CASE("light changes of a take become an experiment that gives the same take") {
    for (const std::string name : {"tiny", "cornell", "hall"}) {
        CAPTURE(name);
        const Scene scene = loadScene(name);
        const bool moves = duration(scene) > 0.0; // then a change is not one of light alone
        Take take = restingTake(scene, 60);
        for (SceneFrame& given : take.frames)
            given.lights[0].power = 0.7f; // how it starts
        change(
            take, 12, [](SceneFrame& m) { m.lights[0].on = false; }, "key off", !moves);
        change(
            take, 13, [](SceneFrame& m) { m.lights[0].on = true; }, "key on", !moves);
        change(
            take, 30,
            [](SceneFrame& m) {
                m.lights[0].tint = {1.0f, 0.1f, 1.0f / 3.0f};
            },
            "key tinted", !moves);
        if (scene.lights.size() > 1)
            change(
                take, 41,
                [](SceneFrame& m) {
                    m.lights[0].power = 0.0f;
                    m.lights[1] = {.on = false, .power = 123.456f, .tint = {0.2f, 0.3f, 0.4f}};
                },
                "two at once", !moves);
        checkSame(throughText(take, name), take);
    }
}

TEST_CASE("a cut of the camera and a flight survive as an experiment") {
    for (const std::string name : {"tiny", "cornell"}) {
        CAPTURE(name);
        const Scene scene = loadScene(name);
        const Lens lens = scene.cameras[0].lens;
        Take take = restingTake(scene, 50, 24.0);
        change(
            take, 5,
            [&](SceneFrame& m) {
                m.camera = lookAt({0.4f, 0.9f, 1.7f}, {0, 0.3f, 0}, lens);
            },
            "camera cut", false);
        for (int i = 20; i < 40; ++i) // curved and ever faster, almost to the zenith
            change(
                take, std::size_t(i),
                [&](SceneFrame& m) {
                    const float t = float(i - 19) / 20.0f;
                    m.camera =
                        lookAt({0.4f + t * t, 0.9f, 1.7f - t},
                               {0.4f + t * t + 0.02f, 0.3f + 1.6f * t, 1.68f - 2.0f * t}, lens);
                },
                "", false);
        for (int i = 20; i < 40; ++i)
            take.frames[std::size_t(i)].marks.clear();
        take.frames[20].marks = {"camera moves"};
        change(
            take, 30, [](SceneFrame& m) { m.lights[0].on = false; }, "key off", false);

        const Take again = throughText(take, name);
        checkSame(again, take);
        CHECK(again.frames[5].marks == std::vector<std::string>{"camera cut"});
        CHECK(again.frames[20].marks == std::vector<std::string>{"camera moves"});
        CHECK(again.frames[30].marks == std::vector<std::string>{"key off"});
    }
}

TEST_CASE("a take that begins elsewhere than the scene's camera is set up so") {
    const Scene scene = loadScene("tiny");
    Take take = restingTake(scene, 8);
    for (SceneFrame& given : take.frames)
        given.camera = lookAt({2.0f, 1.0f, 1.0f}, {0, 0, 0}, scene.cameras[0].lens);
    checkSame(throughText(take, "tiny"), take);

    take.frames[1].camera = lookAt({2.0f, 1.0f, 0.5f}, {0, 0, 0}, scene.cameras[0].lens);
    take.frames[1].marks = {"camera moves"}; // there and back: what was set up is not part of it
    checkSame(throughText(take, "tiny"), take);
}

TEST_CASE("what the window records in a scene that moves is an experiment from time 0 on") {
    const Scene scene = loadScene("moving");
    Transport t;
    SceneFrame live{.camera = cameraAt(scene, poseAt(scene, 0.0)),
                    .lights = std::vector<LightState>(1)};
    for (int i = 0; i < 70; ++i) {
        if (i == 30)
            markIn(t);
        live.lights[0].on = i < 50;
        live.marks = i == 50 ? std::vector<std::string>{"key off"} : std::vector<std::string>{};
        live.step = i == 50;
        nextFrame(t, live);
        frameRendered(t, 0.0);
    }
    markOut(t);
    REQUIRE(t.recorded);
    const Experiment experiment = experimentOf(*t.recorded, scene, baseFor("moving"));
    CHECK(experiment.rate == 60.0);
    CHECK(experiment.animated);
    CHECK(experiment.frames() == 70);
    Take again = throughText(*t.recorded, "moving");
    REQUIRE(again.frames.size() == 70);
    for (std::size_t i = 0; i < 30; ++i)
        CHECK(again.frames[i].lights == t.recorded->frames[0].lights);
    again.frames.erase(again.frames.begin(), again.frames.begin() + 30);
    for (SceneFrame& given : again.frames)
        given.step = given.seconds == 50.0 / 60.0; // the box moves in an experiment, too
    checkSame(again, *t.recorded);
}

TEST_CASE("histories can be given frames to grow in before a take") {
    const Scene scene = loadScene("cornell");
    Take take = restingTake(scene, 10);
    take.frames[0].lights[1].on = false;
    change(
        take, 3, [](SceneFrame& m) { m.lights[0].on = false; }, "key off", true);
    startAt(take, 500);
    const Take again = throughText(take, "cornell", 16);
    REQUIRE(again.frames.size() == 26);
    for (std::size_t i = 0; i < 16; ++i)
        CHECK(again.frames[i].lights == take.frames[0].lights);
    for (std::size_t i = 0; i < 10; ++i)
        CHECK(again.frames[16 + i].lights == take.frames[i].lights);
    CHECK(again.frames[19].step);
    CHECK(again.frames[17].marks == std::vector<std::string>{"fill on"});
}

TEST_CASE("the rate of an experiment is that of the take's seconds, written shortly") {
    const Scene scene = loadScene("tiny");
    for (const double rate : {60.0, 24.0, 23.976, 30.0, 12.5, 0.5, 1000.0}) {
        CAPTURE(rate);
        const Take take = restingTake(scene, 300, rate);
        const Experiment experiment = experimentOf(take, scene, baseFor("tiny"));
        CHECK(experiment.rate == rate);
        CHECK(experiment.animated);
        checkSame(throughText(take, "tiny"), take);
    }
}

TEST_CASE("time makes no difference where nothing moves, and may stand where the scene rests") {
    const Scene tiny = loadScene("tiny"), moving = loadScene("moving");
    Take uneven = restingTake(tiny, 10);
    uneven.frames[4].seconds += 0.01;
    CHECK(experimentOf(uneven, tiny, baseFor("tiny")).rate == 60.0);

    Take standing = restingTake(moving, 10);
    for (SceneFrame& given : standing.frames)
        given.seconds = 0.0;
    CHECK_FALSE(experimentOf(standing, moving, baseFor("moving"), 5).animated);
    CHECK(experimentOf(standing, moving, baseFor("moving"), 5).frames() == 15);
}

TEST_CASE("what an experiment cannot say is refused by name") {
    const Scene tiny = loadScene("tiny"), moving = loadScene("moving");
    const auto refusedIn = [&](const Scene& scene, const std::string& name,
                               const std::function<void(Take&)>& how) {
        Take take = restingTake(scene, 20);
        startAt(take, 100);
        how(take);
        return refusal(take, scene, baseFor(name));
    };
    CHECK(refusedIn(tiny, "tiny", [](Take&) {}) == "none");
    CHECK(refusedIn(moving, "moving", [](Take&) {}) == "none");

    const std::string rolled = refusedIn(tiny, "tiny", [](Take& take) {
        Camera& camera = take.frames[7].camera;
        camera.orientation = camera.orientation * glm::angleAxis(0.01f, glm::vec3(0, 0, 1));
    });
    CHECK(contains(rolled, "take-1: frame 107: the camera is rolled"));

    CHECK(contains(
        refusedIn(tiny, "tiny", [](Take& take) { take.frames[3].camera.lens.verticalFov += 0.1f; }),
        "frame 103: the lens"));
    CHECK(contains(refusedIn(moving, "moving",
                             [](Take& take) {
                                 for (std::size_t i = 9; i < 20; ++i)
                                     take.frames[i].seconds += 0.01;
                             }),
                   "frame 109: scene time does not go on evenly"));
    CHECK(contains(refusedIn(moving, "moving",
                             [](Take& take) {
                                 for (SceneFrame& given : take.frames)
                                     given.seconds = 1.25;
                             }),
                   "stands still at 1.25 s"));
    CHECK(contains(refusedIn(moving, "moving",
                             [](Take& take) {
                                 for (SceneFrame& given : take.frames)
                                     given.seconds += 0.005;
                             }),
                   "begins at 0.005 s"));
    CHECK(contains(refusedIn(moving, "moving",
                             [](Take& take) {
                                 for (SceneFrame& given : take.frames)
                                     given.seconds += 2000.0;
                             }),
                   "begins at 2000 s"));
    CHECK(contains(refusedIn(tiny, "tiny", [](Take& take) { take.frames[0].step = true; }),
                   "begins with a change of light"));
    CHECK(
        contains(refusedIn(tiny, "tiny", [](Take& take) { take.frames[5].lights[0].power = 1e7f; }),
                 "power"));
    CHECK(contains(
        refusedIn(tiny, "tiny", [](Take& take) { take.frames[5].camera.position.x = NAN; }),
        "take-1"));

    Scene bound = tiny; // its camera hangs on the first node
    const std::uint32_t cameraNode = bound.cameras[0].node;
    REQUIRE(cameraNode > 0);
    bound.nodes[cameraNode].parent = 0;
    const auto fly = [](Take& take) { take.frames[5].camera.position.x += 1.0f; };
    CHECK(contains(refusedIn(bound, "tiny", fly), "hangs on another node"));
    CHECK(refusedIn(bound, "tiny", [](Take&) {}) == "none");

    Scene flown = tiny;
    flown.tracks.push_back(
        {.node = cameraNode,
         .times = {0.0, 1.0},
         .values = {glm::vec4(flown.nodes[cameraNode].translation, 0.0f), glm::vec4(0.0f)}});
    CHECK(contains(refusedIn(flown, "tiny", fly), "animated by the scene itself"));
    Take asFlown = restingTake(flown, 20);
    for (SceneFrame& given : asFlown.frames)
        given.camera = cameraAt(flown, poseAt(flown, given.seconds));
    CHECK(experimentOf(asFlown, flown, baseFor("tiny")).timeline.events().empty());

    Experiment twice = baseFor("tiny");
    twice.variants.push_back(variantOf(Filter::Svgf));
    CHECK(contains(refusal(restingTake(tiny, 3), tiny, twice), "each name once"));
    Experiment unnamed = baseFor("tiny");
    unnamed.name = "a/b";
    CHECK(contains(refusal(restingTake(tiny, 3), tiny, unnamed), "name"));
}

TEST_CASE("every experiment that comes with the program and moves no node survives as a take") {
    int tried = 0;
    for (const ExperimentInfo& info : builtInExperiments()) {
        const Experiment experiment = loadExperiment(info.name);
        const auto& events = experiment.timeline.events();
        if (experiment.scene == "hall" || std::ranges::any_of(events, [](const auto& event) {
                return std::holds_alternative<NodeMotion>(event);
            }))
            continue;
        CAPTURE(info.name);
        const Take take = takeOf(experiment, stagedRun(experiment));
        const Take again = throughText(take, experiment.scene);
        ++tried;
        REQUIRE(again.frames.size() == take.frames.size());
        for (std::size_t i = 0; i < take.frames.size(); ++i) {
            CAPTURE(i);
            CHECK(again.frames[i].lights == take.frames[i].lights);
            CHECK(again.frames[i].seconds == take.frames[i].seconds);
            CHECK(again.frames[i].step == take.frames[i].step);
            CHECK(apart(again.frames[i].camera, take.frames[i].camera) < 1e-4f);
        }
    }
    CHECK(tried >= 4);
}
