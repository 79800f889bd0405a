// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <string>

#include "tests/reference/lighting.h"
#include "tests/stage/scene_judges.h"
#include "tests/support/sequence.h"

using namespace afterglow;
using namespace afterglow::test;

namespace {

void check(const std::string& what, const LightingVerdict& verdict) {
    MESSAGE(what, ": ", verdict.surfaces, " surfaces, ", verdict.lit, " lit, ", verdict.shadowed,
            " shadowed, ", verdict.open, " open, ", verdict.occluded, " occluded, excused ",
            verdict.excused, ", largest ", verdict.largest);
    CHECK(verdict.wrong == 0);
    CHECK(verdict.excused <= verdict.surfaces / 200);
    CHECK(verdict.luminance < 1e-6);
}

struct Case {
    std::string scene;
    glm::ivec2 size;
    Signal signal;
    float meters;
};

} // namespace

TEST_CASE("the raw signal is what one light sample and one ambient ray give, pixel by pixel") {
    const GlCheck noGlMessages;
    for (const Case& c :
         {Case{"tiny", {61, 37}, Signal::Shadows, 0.05f},
          Case{"tiny", {61, 37}, Signal::AmbientOcclusion, 0.05f},
          Case{"tiny", {61, 37}, Signal::Both, 0.05f},
          Case{"cornell", {61, 37}, Signal::Shadows, 0.02f},
          Case{"cornell", {61, 37}, Signal::AmbientOcclusion, 0.02f},
          Case{"moving", {61, 37}, Signal::Both, 0.0f},
          Case{"oddities", {61, 37}, Signal::Shadows, 0.05f},
          Case{"oddities", {61, 37}, Signal::AmbientOcclusion, 0.05f},
          Case{"oddities", {61, 37}, Signal::Both, 0.0f}, Case{"tiny", {5, 3}, Signal::Both, 0.05f},
          Case{"hall", {16, 9}, Signal::Shadows, 0.1f},
          Case{"hall", {16, 9}, Signal::AmbientOcclusion, 0.1f}}) {
        CAPTURE(c.scene);
        CAPTURE(c.size.x);
        CAPTURE(nameOf(c.signal));
        // A-SVGF shades the samples that it merges with the seeds of the frame before.
        SceneFrames frames(sceneNamed(c.scene), c.size, settingsOf(Filter::Asvgf, c.signal));
        const Camera start = frames.camera;
        frames.runSeed = 5;
        for (int i = 0; i < (c.scene == "hall" ? 1 : 3); ++i) {
            shake(frames, start, i + 1, c.meters);
            frames.seconds = 0.3 * i;
            frames.frame = i == 0 ? 1000u : frames.frame;
            const LightingVerdict verdict = judgeLighting(frames, frames.next());
            check(c.scene + " " + std::string(nameOf(c.signal)), verdict);
            CHECK(verdict.lit > 0);
        }
    }
}

TEST_CASE("every lamp is picked, in the order of slots, by its power at the start") {
    const GlCheck noGlMessages;
    for (const std::string scene : {"cornell", "oddities"}) {
        CAPTURE(scene);
        SceneFrames frames(sceneNamed(scene), {61, 37}, settingsOf(Filter::None, Signal::Shadows));
        frames.seconds = 0.7;
        const SceneFrame frame = frames.next();
        const LightingVerdict verdict = judgeLighting(frames, frame);
        const auto emitters =
            reference::emittersOf(frames.scene(), frames.rest(), frame.scene, frame.lightScales);
        for (std::size_t i = 0; i < emitters.size(); ++i) {
            MESSAGE("emitter ", i, ": probability ", emitters[i].probability, ", share ",
                    verdict.picks[i] / double(verdict.surfaces));
            CHECK(verdict.picks[i] > 0);
        }
    }
}

TEST_CASE("lamps that are off, dimmed or tinted keep their random numbers and change their light") {
    const GlCheck noGlMessages;
    for (const std::string scene : {"cornell", "oddities"}) {
        CAPTURE(scene);
        SceneFrames frames(sceneNamed(scene), {61, 37}, settingsOf(Filter::Asvgf, Signal::Shadows));
        const std::size_t last = frames.lights.size() - 1;
        for (int i = 0; i < 5; ++i) {
            CAPTURE(i);
            frames.lights[0].on = i != 1;
            frames.lights[0].power = i == 2 ? 0.125f : 1.0f;
            frames.lights[last].tint = i >= 2 ? glm::vec3(0.5f, 2.0f, 0.0f) : glm::vec3(1.0f);
            if (i == 4)
                for (LightState& light : frames.lights)
                    light.on = false;
            const LightingVerdict verdict = judgeLighting(frames, frames.next());
            check(scene, verdict);
            CHECK((verdict.lit == 0) == (i == 4));
        }
    }
}

TEST_CASE("no channel of the signal exceeds the clamp") {
    const GlCheck noGlMessages;
    Settings settings = settingsOf(Filter::None);
    settings.lighting.signalClamp = 0.5f;
    SceneFrames frames(sceneNamed("cornell"), {61, 37}, settings);
    const SceneFrame frame = frames.next();
    check("clamped cornell", judgeLighting(frames, frame));
    int clamped = 0;
    for (const glm::vec4& raw : frame.raw.pixels())
        clamped += raw.r == 0.5f;
    CHECK(clamped > 100);
}

TEST_CASE("ambient rays reach as far as they are told, whatever turned since") {
    const GlCheck noGlMessages;
    for (const float radius : {0.005f, 0.3f, 2.0f}) {
        CAPTURE(radius);
        Settings settings = settingsOf(Filter::Asvgf, Signal::AmbientOcclusion);
        settings.lighting.aoRadius = radius;
        SceneFrames frames(sceneNamed("oddities"), {61, 37}, settings);
        for (int i = 0; i < 3; ++i) {
            frames.seconds = 0.25 * i;
            check("radius " + std::to_string(radius), judgeLighting(frames, frames.next()));
        }
    }
}
