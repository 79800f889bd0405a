// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <string>

#include "tests/reference/composite.h"
#include "tests/stage/scene_judges.h"
#include "tests/support/sequence.h"

using namespace afterglow;
using namespace afterglow::test;

TEST_CASE("the picture is albedo times signal plus emission, and the surroundings behind it") {
    const GlCheck noGlMessages;
    int clipped = 0, dark = 0;
    for (const std::string scene : {"tiny", "cornell", "oddities"})
        for (const Filter filter : {Filter::None, Filter::Asvgf})
            for (const float stops : {0.0f, -3.0f, 2.5f}) {
                CAPTURE(scene);
                CAPTURE(nameOf(filter));
                CAPTURE(stops);
                Settings settings = settingsOf(filter);
                settings.display.exposure = stops;
                SceneFrames frames(sceneNamed(scene), {61, 37}, settings);
                if (scene == "oddities") // lamps in the picture
                    frames.camera =
                        lookAt({1.5f, 0.2f, 2.2f}, {-0.3f, 1.7f, 0.2f}, {.verticalFov = 1.3f});
                frames.next();
                const PictureVerdict verdict = judgePicture(frames, frames.next());
                MESSAGE(scene, " ", nameOf(filter), " ", stops, " stops: composed ",
                        verdict.composed, ", display ", verdict.display, " levels; background ",
                        verdict.background, ", clipped ", verdict.clipped, ", dark ", verdict.dark);
                CHECK(verdict.wrong == 0);
                CHECK(verdict.composed < 1e-6);
                // Half a level is the rounding to 8 bits; the rest is for pow() on GPUs.
                CHECK(verdict.display < 0.51);
                CHECK(verdict.background > 0);
                clipped += verdict.clipped;
                dark += verdict.dark;
            }
    CHECK(clipped > 0);
    CHECK(dark > 0);
}

TEST_CASE("the tone curve rises from black to white, whatever the exposure") {
    double last = -1.0;
    for (int i = 0; i <= 1000; ++i) {
        const double x = std::exp2(0.02 * i - 12.0);
        const double level = reference::display(glm::dvec3(x), 0.0).x;
        CHECK(level >= last);
        CHECK(level == doctest::Approx(reference::display(glm::dvec3(x / 4.0), 2.0).y));
        last = level;
    }
    CHECK(reference::display(glm::dvec3(0.0), 3.0).x == 0.0);
    CHECK(last == doctest::Approx(255.0));
}
