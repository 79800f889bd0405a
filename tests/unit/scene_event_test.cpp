// SPDX-License-Identifier: MIT
#include "app/scenario/experiment.h"
#include "app/workbench/scene_event.h"
#include "renderer/image/color.h"
#include "window_hands.h"

#include <algorithm>

using namespace afterglow;

namespace {

using Texts = std::vector<std::string>;

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
    for (const auto kind : {EventKind::Toggle, EventKind::Dim, EventKind::Recolor})
        for (std::size_t slot = 0; slot < 2; ++slot) {
            ViewState state = cornellState();
            const auto before = state.lights;
            letHappen(state, {kind, slot});
            CHECK(state.repeated == SceneEvent{kind, slot});
            const LightState& light = state.lights[slot];
            CHECK(light.on == (kind != EventKind::Toggle));
            CHECK(light.power == (kind == EventKind::Dim ? 0.5f : 1.0f));
            CHECK((light.tint == glm::vec3(1.0f)) == (kind != EventKind::Recolor));
            CHECK(state.lights[1 - slot] == before[1 - slot]);
            letHappen(state, {kind, slot});
            CHECK(state.lights == before);
            CHECK(state.marks.empty()); // lights tell by themselves what they did
        }
}

TEST_CASE("an event of a light that is not there does nothing and is not remembered") {
    ViewState state = cornellState();
    const SceneEvent before = state.repeated;
    for (const auto kind : {EventKind::Toggle, EventKind::Dim, EventKind::Recolor}) {
        letHappen(state, {kind, 2});
        CHECK(state.lights == std::vector<LightState>(2));
        CHECK(state.repeated == before);
    }
}

TEST_CASE("events on the same light add up") {
    ViewState state = cornellState();
    for (const auto kind : {EventKind::Toggle, EventKind::Dim, EventKind::Recolor})
        letHappen(state, {kind, 1});
    CHECK_FALSE(state.lights[1].on);
    CHECK(state.lights[1].power == 0.5f);
    CHECK(state.lights[1].tint != glm::vec3(1.0f));
}

TEST_CASE("an event is called by what it will do") {
    const Texts names{"key", "fill"};
    using enum EventKind;
    CHECK(nameOf(SceneEvent{Toggle, 0}, names) == "toggle key");
    CHECK(nameOf(SceneEvent{Dim, 1}, names) == "dim fill");
    CHECK(nameOf(SceneEvent{Recolor, 0}, names) == "recolor key");
    CHECK(nameOf(SceneEvent{Toggle, 2}, names) == "toggle no light");
    std::vector<std::string> all;
    for (std::size_t kind = 0; kind < kEventKinds; ++kind)
        all.push_back(nameOf(SceneEvent{EventKind(kind)}, names));
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
    letHappen(state, {EventKind::Recolor, 0});
    const glm::vec3 experiment =
        loadExperiment("light-color").timeline.lightsAt(makeProceduralScene("cornell"), 64)[0].tint;
    CHECK(glm::distance(state.lights[0].tint, experiment) < 1e-4f);
}
