// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <string>

#include "tests/stage/scene_judges.h"
#include "tests/support/sequence.h"

using namespace afterglow;
using namespace afterglow::test;

namespace {

struct Way {
    std::string scene;
    glm::ivec2 size;
    float meters;           ///< of the camera, from frame to frame
    double secondsPerFrame; ///< of the scene
    std::uint32_t firstFrame = 0;
    int jitters = int(AntiAliasing::Off);
};

/// Two renderers on the same frames: one merges samples, the other has the visibility of each
/// frame as it is before that.
ForwardVerdict follow(const Way& way, int frames) {
    SceneFrames merging(sceneNamed(way.scene), way.size,
                        settingsOf(Filter::Asvgf, Signal::Shadows));
    SceneFrames plain(sceneNamed(way.scene), way.size, settingsOf(Filter::None, Signal::Shadows));
    const Camera start = merging.camera;
    ForwardVerdict verdict;
    for (int i = 0; i < frames; ++i) {
        for (SceneFrames* each : {&merging, &plain}) {
            if (i == 0)
                each->frame = way.firstFrame;
            each->settings.display.antiAliasing = way.jitters;
            shake(*each, start, i, way.meters);
            each->seconds = way.secondsPerFrame * i;
        }
        const SceneFrame merged = merging.next(), unmerged = plain.next();
        if (i > 0)
            verdict += judgeForward(merged, unmerged);
        else {
            CHECK(differingPixels(merged.visibility, unmerged.visibility) == 0);
            CHECK(differingPixels(merged.seeds, unmerged.seeds) == 0);
            CHECK(merged.samples.pixels()[0].y == 0);
        }
    }
    return verdict;
}

void report(const Way& way, const ForwardVerdict& verdict) {
    using enum reference::Fate;
    MESSAGE(way.scene, " ", way.size.x, "x", way.size.y, ": ", verdict.filled, " of ",
            verdict.strata, " filled, ", verdict.contested, " contested, excused ", verdict.excused,
            " (", verdict.doubts, " doubtful); background ", verdict.of(Background),
            ", was gradient ", verdict.of(WasGradient), ", off screen ", verdict.of(OffScreen),
            ", other instance ", verdict.of(OtherInstance), ", other depth ",
            verdict.of(OtherDepth), ", landed ", verdict.of(Landed));
}

} // namespace

TEST_CASE("the samples of a still picture stay where they are, every one of them") {
    const GlCheck noGlMessages;
    for (const Way& way : {Way{"tiny", {61, 37}, 0.0f, 0.0}, Way{"cornell", {61, 37}, 0.0f, 0.0},
                           Way{"oddities", {16, 9}, 0.0f, 0.0}, Way{"tiny", {5, 3}, 0.0f, 0.0},
                           Way{"tiny", {61, 37}, 0.0f, 0.0, 262142u}}) {
        CAPTURE(way.scene);
        const ForwardVerdict verdict = follow(way, 5);
        report(way, verdict);
        CHECK(verdict.wrong == 0);
        CHECK(verdict.excused == 0);
        CHECK(verdict.contested == 0);
        CHECK(verdict.lost == 0);
        CHECK(verdict.filled == verdict.of(reference::Fate::Landed));
        CHECK(verdict.of(reference::Fate::OffScreen) == 0);
        CHECK(verdict.of(reference::Fate::OtherInstance) == 0);
        CHECK(verdict.of(reference::Fate::OtherDepth) == 0);
    }
}

TEST_CASE("samples land where their surface went, unless it is hidden or gone") {
    const GlCheck noGlMessages;
    ForwardVerdict all;
    for (const Way& way :
         {Way{"tiny", {61, 37}, 0.06f, 0.0}, Way{"cornell", {61, 37}, 0.02f, 0.0},
          Way{"moving", {61, 37}, 0.0f, 0.2}, Way{"moving", {61, 37}, 0.04f, 0.2},
          Way{"oddities", {61, 37}, 0.05f, 0.1}, Way{"oddities", {61, 37}, 0.0f, 0.1},
          Way{"oddities", {61, 37}, 0.05f, 0.1, 0, int(AntiAliasing::Taa)},
          Way{"cornell", {61, 37}, 0.0f, 0.0, 0, int(AntiAliasing::Taa)},
          Way{"oddities", {16, 9}, 0.1f, 0.1}, Way{"tiny", {5, 3}, 0.1f, 0.0},
          Way{"hall", {16, 9}, 0.2f, 0.1}}) {
        CAPTURE(way.scene);
        CAPTURE(way.size.x);
        const ForwardVerdict verdict = follow(way, 6);
        report(way, verdict);
        CHECK(verdict.wrong == 0);
        CHECK(verdict.excused <= verdict.strata / 200);
        CHECK(verdict.doubts <= 1 + verdict.strata / 50);
        all += verdict;
    }
    using enum reference::Fate;
    for (const auto fate :
         {Background, WasGradient, OffScreen, OtherInstance, OtherDepth, Landed}) {
        CAPTURE(int(fate));
        CHECK(all.of(fate) > 3);
    }
    CHECK(all.contested > 20);
    CHECK(all.lost >= all.contested);
}
