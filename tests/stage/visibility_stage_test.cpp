// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <string>

#include "tests/stage/scene_judges.h"
#include "tests/support/sequence.h"

using namespace afterglow;
using namespace afterglow::test;

TEST_CASE(
    "every pixel shows the nearest front face that the ray through its center, or through its "
    "jittered place, meets") {
    const GlCheck noGlMessages;
    struct Case {
        std::string scene;
        glm::ivec2 size;
        float meters;   ///< of the camera's way from frame to frame
        double excused; ///< the greatest share of pixels
        double weights; ///< the greatest difference of barycentrics: more in small triangles
        int jitters = int(AntiAliasing::Off);
    };
    // In the hall at this size most columns' facets are thinner than a pixel.
    for (const Case& c :
         {Case{"tiny", {61, 37}, 0.05f, 0.002, 3e-5}, Case{"cornell", {61, 37}, 0.02f, 0.002, 3e-5},
          Case{"moving", {61, 37}, 0.05f, 0.002, 3e-5},
          Case{"oddities", {61, 37}, 0.06f, 0.002, 3e-5},
          Case{"oddities", {61, 37}, 0.06f, 0.002, 3e-5, int(AntiAliasing::Taa)},
          Case{"cornell", {61, 37}, 0.02f, 0.002, 3e-5, int(AntiAliasing::Taa)},
          Case{"oddities", {16, 9}, 0.06f, 0.01, 3e-5}, Case{"tiny", {5, 3}, 0.05f, 0.0, 3e-5},
          Case{"hall", {16, 9}, 0.1f, 0.1, 3e-4}}) {
        CAPTURE(c.scene);
        CAPTURE(c.size.x);
        SceneFrames frames(sceneNamed(c.scene), c.size, settingsOf(Filter::None, Signal::Shadows));
        frames.settings.display.antiAliasing = c.jitters;
        const Camera start = frames.camera;
        // Not the camera's own place: from there whole edges lie on centers of pixels.
        for (int i = 1; i < 4; ++i) {
            shake(frames, start, i, c.meters);
            frames.seconds = 0.3 * i;
            const VisibilityVerdict verdict = judgeVisibility(frames.next());
            MESSAGE(c.scene, " ", c.size.x, "x", c.size.y, ": ", verdict.background,
                    " background, excused ", verdict.excused, " of ", verdict.pixels, ", shift ",
                    verdict.largestShift, " pixels, weights ", verdict.largestWeight);
            CHECK(verdict.wrong == 0);
            CHECK(verdict.excused <= c.excused * verdict.pixels);
            CHECK(verdict.largestShift < 5e-4);
            CHECK(verdict.largestWeight < c.weights);
        }
    }
}

TEST_CASE("a seed is the pixel's place and the frame's number, each as far as it fits") {
    const GlCheck noGlMessages;
    SceneFrames frames(sceneNamed("tiny"), {200, 140}, settingsOf(Filter::None, Signal::Shadows));
    for (const std::uint32_t number : {0u, 1u, 77u, 262143u, 262144u, 262149u, 4000000000u}) {
        CAPTURE(number);
        frames.frame = number;
        const SceneFrame frame = frames.next();
        int different = 0;
        for (int y = 0; y < 140; ++y)
            for (int x = 0; x < 200; ++x)
                different += frame.seeds({x, y}) != reference::packSeed({x, y}, number);
        CHECK(different == 0);
    }
}
