#include "app/experiment/timeline.h"

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

} // namespace

TEST_CASE("a light's scale is its power times its tint, and nothing when it is off") {
    LightState state{.on = true, .power = 2.0f, .tint = {1.0f, 0.5f, 0.25f}};
    CHECK(state.scale() == glm::vec3(2.0f, 1.0f, 0.5f));
    state.on = false;
    CHECK(state.scale() == glm::vec3(0.0f));
}

TEST_CASE("without events every light is as the scene has it") {
    const Timeline timeline(10, {});
    CHECK(timeline.lightsAt(0).of("key") == LightState{});
    CHECK(timeline.lightsAt(9) == LightSettings{});
    const std::vector<Segment> segments = timeline.segments();
    REQUIRE(segments.size() == 1);
    CHECK(segments[0].first == 0);
    CHECK(segments[0].end == 10);
    CHECK(Timeline().segments().empty());
}

TEST_CASE("an event holds from its own frame on, for its own light, until another") {
    const Timeline timeline(100, {turned(20, "key", false), turned(50, "key", true)});
    CHECK(timeline.lightsAt(19).of("key").on);
    CHECK_FALSE(timeline.lightsAt(20).of("key").on);
    CHECK(timeline.lightsAt(20).of("fill").on);
    CHECK_FALSE(timeline.lightsAt(49).of("key").on);
    CHECK(timeline.lightsAt(50).of("key").on);
    CHECK(timeline.lightNames() == std::vector<std::string>{"key"});
}

TEST_CASE("an event changes only what it says") {
    const Timeline timeline(10, {powered(1, "key", 3.0f), tinted(2, "key", {1.0f, 0.5f, 0.0f}),
                                 turned(3, "key", false), turned(4, "key", true)});
    CHECK(timeline.lightsAt(4).of("key") ==
          LightState{.on = true, .power = 3.0f, .tint = {1.0f, 0.5f, 0.0f}});
    CHECK(timeline.lightsAt(3).of("key").scale() == glm::vec3(0.0f));
}

TEST_CASE("all lights can be set at once, before and after one is set apart") {
    const Timeline timeline(10,
                            {turned(0, "*", false), turned(0, "key", true), powered(5, "*", 0.5f)});
    CHECK(timeline.lightsAt(0).of("key").on);
    CHECK_FALSE(timeline.lightsAt(0).of("fill").on);
    CHECK(timeline.lightsAt(0).of("key").power == 1.0f);
    CHECK(timeline.lightsAt(5).of("key").scale() == glm::vec3(0.5f));
    CHECK(timeline.lightsAt(5).of("lantern 3").power == 0.5f);
    CHECK_FALSE(timeline.lightsAt(5).of("lantern 3").on);
    CHECK(timeline.lightNames() == std::vector<std::string>{"key"});
}

TEST_CASE("segments end where something changes and nowhere else") {
    const Timeline timeline(60, {turned(0, "fill", false),  // how it starts
                                 turned(10, "fill", false), // so it was already
                                 turned(20, "key", false),  // a change,
                                 turned(20, "key", true),   // taken back in the same frame
                                 turned(30, "key", false),  //
                                 powered(30, "fill", 2.0f), // two at once
                                 turned(59, "key", true)}); // the last frame is a segment, too
    const std::vector<Segment> segments = timeline.segments();
    REQUIRE(segments.size() == 3);
    CHECK(segments[0].first == 0);
    CHECK(segments[0].end == 30);
    CHECK(segments[1].first == 30);
    CHECK(segments[1].frames() == 29);
    CHECK(segments[2].first == 59);
    CHECK(segments[2].end == 60);
    CHECK_FALSE(segments[0].lights.of("fill").on);
    CHECK(segments[1].lights.of("fill").power == 2.0f);
}

TEST_CASE(
    "the segments of any timeline cover it, agree with its frames, and are as long as can be") {
    std::mt19937 random(3);
    for (int round = 0; round < 50; ++round) {
        std::vector<LightEvent> events;
        int frame = 0;
        while ((frame += int(random() % 5)) < 40)
            events.push_back(turned(frame, random() % 3 ? "key" : "*", random() % 2));
        const Timeline timeline(40, events);
        const std::vector<Segment> segments = timeline.segments();
        int next = 0;
        for (std::size_t i = 0; i < segments.size(); ++i) {
            CHECK(segments[i].first == next);
            CHECK(segments[i].frames() > 0);
            for (next = segments[i].first; next < segments[i].end; ++next)
                CHECK(timeline.lightsAt(next) == segments[i].lights);
            if (i > 0)
                CHECK_FALSE(segments[i].lights == segments[i - 1].lights);
        }
        CHECK(next == 40);
    }
}

TEST_CASE("settings are equal if all lights are, however they came to be") {
    LightSettings a, b;
    a.apply(turned(0, "key", true)); // named, but as all others are
    CHECK(a == b);
    a.apply(turned(0, "*", false));
    CHECK_FALSE(a == b);
    b.apply(turned(0, "key", false));
    CHECK_FALSE(a == b);
    b.apply(turned(0, "*", false));
    CHECK(a == b);
}

TEST_CASE("a timeline out of order or out of range is our mistake") {
    CHECK_THROWS_AS(Timeline(10, {turned(5, "key", true), turned(4, "key", true)}),
                    std::logic_error);
    CHECK_THROWS_AS(Timeline(10, {turned(10, "key", true)}), std::logic_error);
    CHECK_THROWS_AS(Timeline(10, {turned(-1, "key", true)}), std::logic_error);
}
