// SPDX-License-Identifier: MIT
// The workbench's frame times, as shown and as exported.

#include "app/workbench/workbench.h"
#include "program.h"
#include "renderer/scene/procedural.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/sequence.h"

#include <doctest/doctest.h>

using namespace afterglow;
using namespace afterglow::test;

TEST_CASE("the time of a frame is that of its own work, however seldom the window wants one") {
    const GlCheck noGlMessages;
    constexpr glm::ivec2 size{61, 37};
    constexpr double secondsBetweenFrames = 30.0;
    constexpr std::size_t frames = 20;
    for (const bool software : {true, false}) {
        CAPTURE(software);
        const TemporaryFolder folder;
        GlInfo gl = glInfo(testContext());
        gl.softwareRasterizer = software;
        ViewState state = startState(makeProceduralScene("tiny"), settingsOf(Filter::Svgf));
        state.resolution = {.followWindow = false, .scale = 1.0f, .fixed = size};
        state.showPasses = true;
        Workbench workbench(testShaders(), gl, makeProceduralScene("tiny"), state,
                            {folder.path(), folder.path() / "presets"});
        for (std::size_t i = 0; i < frames; ++i)
            REQUIRE(workbench.advance(secondsBetweenFrames, size));
        workbench.finishMeasuring();
        const PassTimings& timings = workbench.timings();
        MESSAGE("a frame: ", timings.frame(), " ms, its passes: ", timings.passTotal(), " ms");
        CHECK(timings.frame() < 1000.0 * secondsBetweenFrames / 10.0);
        // Each frame once; by queries the last ones may not be known yet.
        CHECK(timings.frames().size() <= frames);
        CHECK(timings.frames().size() >= (software ? frames : 1));
        REQUIRE(timings.passes().size() > 5);
        CHECK(timings.passes().front().name == "visibility");
        CHECK(timings.history(0).size() == timings.frames().size() - 1); // without the first
        REQUIRE(workbench.stats().rays > 0);
        if (timings.frame() > 0.0) // a software rasterizer's queries may say nothing
            CHECK(workbench.raysPerSecond() ==
                  doctest::Approx(1000.0 * double(workbench.stats().rays) / timings.frame()));
    }
}
