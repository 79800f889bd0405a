// SPDX-License-Identifier: MIT
#include "app/scenario/timeline.h"
#include "renderer/base/error.h"
#include "renderer/scene/procedural.h"

#include <algorithm>
#include <random>
#include <stdexcept>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

LightEvent turned(int frame, std::string light, bool on) {
    LightEvent event{.frame = frame, .light = std::move(light)};
    event.on = on;
    return event;
}

LightEvent powered(int frame, std::string light, float power) {
    LightEvent event{.frame = frame, .light = std::move(light)};
    event.power = power;
    return event;
}

LightEvent tinted(int frame, std::string light, glm::vec3 tint) {
    LightEvent event{.frame = frame, .light = std::move(light)};
    event.tint = tint;
    return event;
}

/// How the timeline sets a light of the scene "cornell": "key" or "fill".
LightState lightAt(const Timeline& timeline, int frame, std::string_view light) {
    return timeline.lightsAt(makeProceduralScene("cornell"), frame).at(light == "key" ? 0 : 1);
}

} // namespace

TEST_CASE("a light's scale is its power times its tint, and nothing when it is off") {
    LightState state{.on = true, .power = 2.0f, .tint = {1.0f, 0.5f, 0.25f}};
    CHECK(state.scale() == glm::vec3(2.0f, 1.0f, 0.5f));
    state.on = false;
    CHECK(state.scale() == glm::vec3(0.0f));
}

TEST_CASE("without events every light is as the scene has it") {
    const Timeline timeline(10, {});
    CHECK(lightAt(timeline, 0, "key") == LightState{});
    CHECK(lightAt(timeline, 9, "fill") == LightState{});
    const std::vector<Interval> intervals =
        intervalsOf(timeline, makeProceduralScene("rooms"), 60.0);
    REQUIRE(intervals.size() == 1);
    CHECK(intervals[0].first == 0);
    CHECK(intervals[0].end == 10);
    CHECK(intervals[0].start.lights == std::vector<LightState>(2));
    CHECK_FALSE(timeline.moves());
}

TEST_CASE("an event holds from its own frame on, for its own light, until another") {
    const Timeline timeline(100, {turned(20, "key", false), turned(50, "key", true)});
    CHECK(lightAt(timeline, 19, "key").on);
    CHECK_FALSE(lightAt(timeline, 20, "key").on);
    CHECK(lightAt(timeline, 20, "fill").on);
    CHECK_FALSE(lightAt(timeline, 49, "key").on);
    CHECK(lightAt(timeline, 50, "key").on);
}

TEST_CASE("an event changes only what it says") {
    const Timeline timeline(10, {powered(1, "key", 3.0f), tinted(2, "key", {1.0f, 0.5f, 0.0f}),
                                 turned(3, "key", false), turned(4, "key", true)});
    CHECK(lightAt(timeline, 4, "key") ==
          LightState{.on = true, .power = 3.0f, .tint = {1.0f, 0.5f, 0.0f}});
    CHECK(lightAt(timeline, 3, "key").scale() == glm::vec3(0.0f));
}

TEST_CASE("all lights can be set at once, before and after one is set apart") {
    const Timeline timeline(10,
                            {turned(0, "*", false), turned(0, "key", true), powered(5, "*", 0.5f)});
    CHECK(lightAt(timeline, 0, "key").on);
    CHECK_FALSE(lightAt(timeline, 0, "fill").on);
    CHECK(lightAt(timeline, 0, "key").power == 1.0f);
    CHECK(lightAt(timeline, 5, "key").scale() == glm::vec3(0.5f));
    CHECK(lightAt(timeline, 5, "fill").power == 0.5f);
    CHECK_FALSE(lightAt(timeline, 5, "fill").on);
}

TEST_CASE("intervals end where something changes and nowhere else") {
    const Timeline timeline(60, {turned(0, "fill", false),  // how it starts
                                 turned(10, "fill", false), // so it was already
                                 turned(20, "key", false),  // a change,
                                 turned(20, "key", true),   // taken back in the same frame
                                 turned(30, "key", false),  //
                                 powered(30, "fill", 2.0f), // two at once
                                 powered(40, "key", 0.5f),  // of a light that is off
                                 turned(59, "key", true)}); // the last frame is an interval, too
    const Scene scene = makeProceduralScene("cornell");     // key, fill
    const std::vector<Interval> intervals = intervalsOf(timeline, scene, 60.0);
    REQUIRE(intervals.size() == 3);
    CHECK(intervals[0].first == 0);
    CHECK(intervals[0].end == 30);
    CHECK_FALSE(intervals[0].isStep());
    CHECK(intervals[1].first == 30);
    CHECK(intervals[1].frames() == 29);
    CHECK(intervals[1].isStep());
    CHECK(intervals[2].first == 59);
    CHECK(intervals[2].end == 60);
    CHECK_FALSE(intervals[0].start.lights[1].on);
    CHECK(intervals[1].start.lights[1].power == 2.0f);
    for (const int frame : {0, 29, 30, 58, 59}) {
        const Interval& interval = intervals[intervalAt(intervals, frame)];
        CHECK(interval.first <= frame);
        CHECK(frame < interval.end);
    }
}

TEST_CASE(
    "the intervals of any timeline cover it, agree with its frames, and are as long as can be") {
    std::mt19937 random(3);
    const Scene scene = makeProceduralScene("cornell");
    for (int round = 0; round < 50; ++round) {
        std::vector<TimelineEvent> events;
        int frame = 0;
        while ((frame += int(random() % 5)) < 40)
            events.push_back(turned(frame, random() % 3 ? "key" : "*", random() % 2));
        const Timeline timeline(40, events);
        const std::vector<Interval> intervals = intervalsOf(timeline, scene, 30.0);
        int next = 0;
        for (std::size_t i = 0; i < intervals.size(); ++i) {
            CHECK(intervals[i].first == next);
            CHECK(intervals[i].frames() > 0);
            for (next = intervals[i].first; next < intervals[i].end; ++next) {
                CHECK(lightAt(timeline, next, "key") == intervals[i].start.lights[0]);
                CHECK(lightAt(timeline, next, "fill") == intervals[i].start.lights[1]);
            }
            if (i > 0)
                CHECK(intervals[i].start.lights != intervals[i - 1].start.lights);
        }
        CHECK(next == 40);
    }
}

TEST_CASE(
    "a node glides from where it was, shows its first step in the event's frame, and arrives") {
    constexpr double kRate = 24.0;
    const Timeline timeline(
        30, {NodeMotion{.frame = 0, .node = "mover", .by = {0.0f, 0.5f, 0.0f}},
             NodeMotion{.frame = 10, .until = 14, .node = "mover", .by = {2.0f, 0.0f, 0.0f}},
             NodeMotion{.frame = 20, .until = 21, .node = "mover", .by = {0.0f, 0.0f, 1.0f}}});
    CHECK(timeline.moves());
    const Scene still = makeProceduralScene("moving");
    const Scene scene = timeline.staged(still, kRate, false, "test");
    const auto node = std::ranges::find(scene.nodes, "mover", &Node::name) - scene.nodes.begin();
    const glm::vec3 rest = still.nodes[std::size_t(node)].translation + glm::vec3(0.0f, 0.5f, 0.0f);
    const auto at = [&](int frame) {
        return glm::vec3(poseAt(scene, frame / kRate).worldFromNode[std::size_t(node)][3]) - rest;
    };
    const auto near = [](glm::vec3 a, glm::vec3 b) { return glm::length(a - b) < 1e-5f; };
    for (const int frame : {0, 5, 9})
        CHECK(at(frame) == glm::vec3(0.0f));
    for (int step = 1; step <= 4; ++step)
        CHECK(near(at(9 + step), {0.5f * float(step), 0.0f, 0.0f}));
    CHECK(at(13) == at(19));
    CHECK(near(at(20), {2.0f, 0.0f, 1.0f}));
    CHECK(at(20) == at(29));

    const std::vector<Interval> intervals = intervalsOf(timeline, scene, kRate);
    REQUIRE(intervals.size() == 6); // [0, 10), 10, 11, 12, [13, 20), [20, 30)
    CHECK(intervals[1].first == 10);
    CHECK(intervals[4].first == 13);
    CHECK(intervals[4].end == 20);
    CHECK(intervals[5].changed.world);
    CHECK_FALSE(intervals[5].changed.camera);
    CHECK_FALSE(intervals[5].isStep());
}

TEST_CASE("the camera arrives at the view that it was sent to, and the scene stands still") {
    const glm::vec3 eye{1.0f, 2.0f, 3.0f}, target{0.0f, 1.0f, 0.0f};
    const Timeline timeline(20, {CameraMove{.frame = 5, .until = 9, .eye = eye, .target = target}});
    const Scene scene = timeline.staged(makeProceduralScene("moving"), 60.0, false, "test");
    const Camera view = cameraAt(scene, poseAt(scene, 8 / 60.0)), wanted = lookAt(eye, target);
    CHECK(glm::length(view.position - wanted.position) < 1e-5f);
    CHECK(glm::length(view.forward() - wanted.forward()) < 1e-5f);
    const std::vector<Interval> intervals = intervalsOf(timeline, scene, 60.0);
    REQUIRE(intervals.size() == 5);
    for (std::size_t i = 1; i < intervals.size(); ++i) {
        CHECK(intervals[i].changed.camera);
        CHECK_FALSE(intervals[i].changed.world);
    }
}

TEST_CASE("the scene's own animation stands still unless it is asked for") {
    const Timeline timeline(4, {});
    const Scene scene = makeProceduralScene("moving");
    CHECK(intervalsOf(timeline, timeline.staged(scene, 60.0, false, "test"), 60.0).size() == 1);
    CHECK(intervalsOf(timeline, timeline.staged(scene, 60.0, true, "test"), 60.0).size() == 4);
}

TEST_CASE("a light or a node that the scene does not have is named, with the nearest it has") {
    const auto complaint = [](TimelineEvent event, bool animated = false) -> std::string {
        try {
            Timeline(10, {std::move(event)})
                .staged(makeProceduralScene("moving"), 60.0, animated, "mine.json");
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    };
    CHECK(
        complaint(turned(0, "keys", true))
            .starts_with("mine.json: timeline: no light of the scene moving named 'keys'; did you "
                         "mean 'key'?"));
    CHECK(complaint(NodeMotion{.frame = 1, .until = 2, .node = "movers"})
              .starts_with("mine.json: timeline: no node of the scene moving named 'movers'; did "
                           "you mean 'mover'?"));
    CHECK(complaint(NodeMotion{.frame = 1, .until = 2, .node = "mover"}) == "accepted");
    CHECK(complaint(NodeMotion{.frame = 1, .until = 2, .node = "mover"}, true) ==
          "mine.json: timeline: 'mover' is animated by the scene itself; it cannot be moved as "
          "well");
}

TEST_CASE("a change of lights is told light by light") {
    using Texts = std::vector<std::string>;
    const Texts names{"key", "fill", "lamp"};
    const auto told = [&](std::span<const LightState> before, std::span<const LightState> after) {
        Texts texts;
        for (const LightEvent& change : lightChanges(3, names, before, after)) {
            CHECK(change.frame == 3);
            texts.push_back(describe(change));
        }
        return texts;
    };
    const std::vector<LightState> before(3);
    auto after = before;
    CHECK(told(before, after).empty());
    after[0].on = false;
    after[2].power = 0.5f;
    CHECK(told(before, after) == Texts{"key off", "lamp to 50 %"});
    CHECK(told(after, before) == Texts{"key on", "lamp to 100 %"});
    after[2].power = 0.125f;
    after[2].tint = {1, 0, 0};
    CHECK(told(before, after) == Texts{"key off", "lamp to 12.5 % tinted"});
    CHECK(told(after, before) == Texts{"key on", "lamp to 100 % untinted"});
    CHECK(told({}, after) ==
          told(before, after)); // lights that are missing are as the scene has them
    CHECK(told(after, std::span(after).first(1)) == Texts{"lamp to 100 % untinted"});
    CHECK(lightChanges(3, {}, before, after).empty());
}

TEST_CASE("events say what they are") {
    CHECK(describe(turned(1, "key", false)) == "key off");
    CHECK(describe(powered(1, "*", 0.5f)) == "all lights to 50 %");
    CHECK(describe(NodeMotion{.frame = 3, .until = 9, .node = "box"}) == "box moves");
    CHECK(describe(NodeMotion{.frame = 3, .until = 4, .node = "box"}) == "box jumps");
    CHECK(describe(CameraMove{.frame = 3, .until = 4}) == "camera cut");
    CHECK(describe(CameraMove{.frame = 3, .until = 5}) == "camera moves");
}

TEST_CASE("events that set lights whole become a timeline that says only what changes") {
    const auto whole = [](int frame, std::string light, bool on, float power) {
        return LightEvent{.frame = frame, .light = std::move(light), .on = on, .power = power};
    };
    const Scene scene = makeProceduralScene("cornell");
    const Timeline timeline = lightTimeline(scene,
                                            {whole(9, "key", true, 1.0f), // in any order
                                             whole(2, "key", true, 0.5f),
                                             whole(4, "key", false, 1.0f),    // full power again
                                             whole(4, "fill", true, 1.0f),    // as it is
                                             whole(7, "key", false, 1.0f),    // as it is by then
                                             whole(12, "fill", false, 1.0f)}, // past the end
                                            12);
    LightEvent second = turned(4, "key", false);
    second.power = 1.0f;
    CHECK(timeline.frames() == 12);
    CHECK(timeline.events() ==
          std::vector<TimelineEvent>{powered(2, "key", 0.5f), second, turned(9, "key", true)});
    CHECK_THROWS_WITH_AS(lightTimeline(scene, {whole(99, "kye", true, 1.0f)}, 12),
                         doctest::Contains("cornell: no light named 'kye'; did you mean 'key'?"),
                         UsageError);
}

TEST_CASE("a timeline out of order or out of range is our mistake") {
    CHECK_THROWS_AS(Timeline(10, {turned(5, "key", true), turned(4, "key", true)}),
                    std::logic_error);
    CHECK_THROWS_AS(Timeline(10, {turned(10, "key", true)}), std::logic_error);
    CHECK_THROWS_AS(Timeline(10, {turned(-1, "key", true)}), std::logic_error);
    const auto glides = [](int frame, int until) {
        return NodeMotion{.frame = frame, .until = until, .node = "a"};
    };
    CHECK_THROWS_AS(Timeline(10, {glides(5, 5)}), std::logic_error);
    CHECK_THROWS_AS(Timeline(10, {glides(2, 6), glides(5, 7)}), std::logic_error);
    CHECK_NOTHROW(Timeline(10, {glides(2, 6), glides(6, 20)}));
}
