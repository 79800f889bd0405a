#include "app/scenario/experiment.h"
#include "app/workbench/scene_event.h"
#include "renderer/image/color.h"
#include "window_hands.h"

#include <algorithm>
#include <cmath>

using namespace afterglow;

namespace {

using Texts = std::vector<std::string>;

std::vector<Camera> fiveKeys() {
    return {lookAt({0, 1, 5}, {0, 1, 0}), lookAt({2, 1, 4}, {0, 1, 0}, {.verticalFov = 0.5f}),
            lookAt({4, 3, 0}, {0, 0, 0}), lookAt({0, 2, -5}, {3, 1, 0}, {.verticalFov = 1.2f}),
            lookAt({-3, 1, 0}, {0, 1, 1})};
}

float angleBetween(const glm::quat& a, const glm::quat& b) {
    const glm::quat d = glm::conjugate(a) * b; // exact near zero, where acos is not
    return 2.0f * std::atan2(glm::length(glm::vec3(d.x, d.y, d.z)), std::abs(d.w));
}

std::vector<glm::vec3> manyColors() {
    std::vector<glm::vec3> colors;
    for (const float r : {0.0f, 0.01f, 1.0f, 17.0f})
        for (const float g : {0.0f, 0.3f, 1.0f, 12.0f})
            for (const float b : {0.0f, 0.02f, 1.0f, 40.0f})
                if (r + g + b > 0.0f)
                    colors.push_back({r, g, b});
    return colors;
}

} // namespace

TEST_CASE("a light event that happens twice leaves the light as it was, and the others alone") {
    for (const auto kind :
         {SceneEvent::Kind::ToggleLight, SceneEvent::Kind::DimLight, SceneEvent::Kind::ColorLight})
        for (std::size_t slot = 0; slot < 2; ++slot) {
            ViewState state = cornellState();
            const auto before = state.lights;
            cause(state, {kind, slot});
            CHECK(state.repeated == SceneEvent{kind, slot});
            const LightState& light = state.lights[slot];
            CHECK(light.on == (kind != SceneEvent::Kind::ToggleLight));
            CHECK(light.power == (kind == SceneEvent::Kind::DimLight ? 0.5f : 1.0f));
            CHECK((light.tint == glm::vec3(1.0f)) == (kind != SceneEvent::Kind::ColorLight));
            CHECK(state.lights[1 - slot] == before[1 - slot]);
            cause(state, {kind, slot});
            CHECK(state.lights == before);
            CHECK(state.marks.empty()); // lights tell by themselves what they did
        }
}

TEST_CASE("an event of a light that is not there does nothing and is not remembered") {
    ViewState state = cornellState();
    const SceneEvent before = state.repeated;
    for (const auto kind : {SceneEvent::Kind::ToggleLight, SceneEvent::Kind::DimLight,
                            SceneEvent::Kind::ColorLight}) {
        cause(state, {kind, 2});
        CHECK(state.lights == std::vector<LightState>(2));
        CHECK(state.repeated == before);
    }
}

TEST_CASE("events on the same light add up") {
    ViewState state = cornellState();
    for (const auto kind :
         {SceneEvent::Kind::ToggleLight, SceneEvent::Kind::DimLight, SceneEvent::Kind::ColorLight})
        cause(state, {kind, 1});
    CHECK_FALSE(state.lights[1].on);
    CHECK(state.lights[1].power == 0.5f);
    CHECK(state.lights[1].tint != glm::vec3(1.0f));
}

TEST_CASE("an event is called by what it will do") {
    const Texts names{"key", "fill"};
    using enum SceneEvent::Kind;
    CHECK(nameOf({ToggleLight, 0}, names) == "toggle key");
    CHECK(nameOf({DimLight, 1}, names) == "dim fill");
    CHECK(nameOf({ColorLight, 0}, names) == "recolor key");
    CHECK(nameOf({ToggleLight, 2}, names) == "toggle no light");
    std::vector<std::string> all;
    for (int kind = 0; kind < kSceneEventKinds; ++kind)
        all.push_back(nameOf({SceneEvent::Kind(kind), 0}, names));
    std::ranges::sort(all);
    CHECK(std::ranges::adjacent_find(all) == all.end());
    CHECK(all.front() != "");
}

TEST_CASE("another color has the same luminance, and another hue where light has one to change") {
    for (const glm::vec3& color : manyColors()) {
        CAPTURE(color.r);
        CAPTURE(color.g);
        CAPTURE(color.b);
        const glm::vec3 tinted = color * equalLuminanceTint(color);
        CHECK(luminance(tinted) == doctest::Approx(luminance(color)).epsilon(1e-5));
        // A light of one primary has no other hue to go to: a tint multiplies.
        const int channels = (color.r > 0.0f) + (color.g > 0.0f) + (color.b > 0.0f);
        const glm::vec3 before = color / (color.r + color.g + color.b);
        const glm::vec3 after = tinted / (tinted.r + tinted.g + tinted.b);
        const float least = std::min({color.r > 0 ? before.r : 1.0f, color.g > 0 ? before.g : 1.0f,
                                      color.b > 0 ? before.b : 1.0f});
        CHECK((glm::distance(before, after) > 0.1f * least) == (channels > 1));
        CHECK(after.b >= before.b - 1e-6f); // bluer
    }
    CHECK(glm::all(glm::greaterThanEqual(equalLuminanceTint(glm::vec3(0.0f)), glm::vec3(0.0f))));
}

TEST_CASE("the key light of the Cornell box turns as in the experiment light-color") {
    ViewState state = cornellState();
    cause(state, {SceneEvent::Kind::ColorLight, 0});
    const glm::vec3 experiment =
        loadExperiment("light-color").timeline.lightsAt(makeProceduralScene("cornell"), 64)[0].tint;
    CHECK(glm::distance(state.lights[0].tint, experiment) < 1e-4f);
}

TEST_CASE("a change of lights is told light by light") {
    const Texts names{"key", "fill", "lamp"};
    const std::vector<LightState> before(3);
    auto after = before;
    CHECK(describeChange(names, before, after).empty());
    after[0].on = false;
    after[2].power = 0.5f;
    CHECK(describeChange(names, before, after) == Texts{"key off", "lamp to 50 %"});
    CHECK(describeChange(names, after, before) == Texts{"key on", "lamp to 100 %"});
    after[2].power = 0.125f;
    after[2].tint = {1, 0, 0};
    CHECK(describeChange(names, before, after) == Texts{"key off", "lamp to 12.5 % tinted"});
    CHECK(describeChange(names, after, before) == Texts{"key on", "lamp to 100 % untinted"});
    CHECK(describeChange({}, before, after).empty());
    CHECK(describeChange(names, std::span(before).first(1), after) == Texts{"key off"});
}

TEST_CASE("a camera path goes through its keys, one every three seconds, and around") {
    for (std::size_t count = 2; count <= 5; ++count) {
        auto keys = fiveKeys();
        keys.resize(count);
        for (int i = -3; i < 12; ++i) {
            CAPTURE(count);
            CAPTURE(i);
            const Camera& key = keys[std::size_t((i + 10 * int(count)) % int(count))];
            const Camera camera = onPath(keys, i * kSecondsPerKey);
            CHECK(glm::distance(camera.position, key.position) < 1e-5f);
            CHECK(angleBetween(camera.orientation, key.orientation) < 1e-3f);
            CHECK(camera.lens.verticalFov == doctest::Approx(key.lens.verticalFov));
        }
    }
}

TEST_CASE("a camera path makes no jump and no corner, in place and direction") {
    for (std::size_t count = 2; count <= 5; ++count) {
        auto keys = fiveKeys();
        keys.resize(count);
        float leg = 0.0f, turn = 0.0f, zoom = 0.0f;
        for (std::size_t i = 0; i < count; ++i) {
            const Camera &a = keys[i], &b = keys[(i + 1) % count];
            leg = std::max(leg, glm::distance(a.position, b.position));
            turn = std::max(turn, angleBetween(a.orientation, b.orientation));
            zoom = std::max(zoom, std::abs(a.lens.verticalFov - b.lens.verticalFov));
        }
        // Of the way from key to key in a frame. A Catmull-Rom spline is nowhere faster than 2.5 of
        // its longest leg a key, and smoothstep than 1.5; accelerations are below 10 and 6.
        constexpr float kPart = float(kFixedStep / kSecondsPerKey), kRounding = 4e-6f;
        Camera before = onPath(keys, 0.0), first = onPath(keys, -kFixedStep);
        for (int frame = 1; frame < int(count) * 180 + 90; ++frame) {
            CAPTURE(count);
            CAPTURE(frame);
            const Camera now = onPath(keys, frame * kFixedStep);
            const glm::vec3 step = now.position - before.position,
                            stepBefore = before.position - first.position;
            REQUIRE(glm::length(step) <= 2.5f * leg * kPart);
            REQUIRE(glm::distance(step, stepBefore) <= 10.0f * leg * kPart * kPart + kRounding);
            const float angle = angleBetween(before.orientation, now.orientation),
                        angleBefore = angleBetween(first.orientation, before.orientation);
            REQUIRE(angle <= 1.5f * turn * kPart + kRounding);
            REQUIRE(std::abs(angle - angleBefore) <= 6.0f * turn * kPart * kPart + kRounding);
            REQUIRE(std::abs(now.lens.verticalFov - before.lens.verticalFov) <=
                    1.5f * zoom * kPart + kRounding);
            REQUIRE(glm::length(now.orientation) == doctest::Approx(1.0));
            first = before;
            before = now;
        }
    }
}

TEST_CASE("a sway begins at home and keeps looking at its target, at the keys and between") {
    for (const Camera& home : fiveKeys()) {
        constexpr float kDistance = 2.5f;
        const glm::vec3 target = home.position + kDistance * home.forward();
        const auto keys = swayAround(home, kDistance);
        REQUIRE(keys.size() >= 2);
        CHECK(keys.front() == home);
        const auto off = [&](const Camera& camera) {
            const glm::vec3 toward = glm::normalize(target - camera.position);
            return glm::length(glm::cross(toward, camera.forward())); // the sine of the angle
        };
        float widest = 0.0f;
        for (const Camera& key : keys) {
            CHECK(off(key) < 1e-4f);
            CHECK(glm::distance(key.position, target) < 1.1f * kDistance);
            CHECK(key.lens.verticalFov == home.lens.verticalFov);
            widest = std::max(widest, glm::distance(key.position, home.position));
        }
        CHECK(widest > 0.1f * kDistance);
        // Between keys place and direction do not keep the same pace.
        constexpr float kMost = 0.035f; // radians; measured: 0.0337
        for (double seconds = 0.0; seconds < 4 * kSecondsPerKey; seconds += kFixedStep)
            REQUIRE(off(onPath(keys, seconds)) < kMost);
    }
}
