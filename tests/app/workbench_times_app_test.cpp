// SPDX-License-Identifier: MIT
// The workbench's frame times, as shown and as exported.

#include "app/workbench/workbench.h"
#include "program.h"
#include "renderer/scene/procedural.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/sequence.h"

#include <algorithm>

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
        // Each frame once, without those that compiled; by queries the last ones may not be known
        // yet.
        CHECK(timings.frames().size() < frames);
        CHECK(timings.frames().size() >= (software ? frames - 3 : 1));
        REQUIRE(timings.passes().size() > 5);
        CHECK(timings.passes().front().name == "visibility");
        CHECK(timings.history(0).size() == timings.frames().size());
        REQUIRE(workbench.stats().rays > 0);
        if (timings.frame() > 0.0) // a software rasterizer's queries may say nothing
            CHECK(workbench.raysPerSecond() ==
                  doctest::Approx(1000.0 * double(workbench.stats().rays) / timings.frame()));
    }
}

TEST_CASE("frames in which programs are compiled are no frame times") {
    const GlCheck noGlMessages;
    constexpr glm::ivec2 size{61, 37};
    const TemporaryFolder folder;
    const GlInfo gl = glInfo(testContext());
    ShaderLibrary shaders = makeShaderLibrary(gl); // of its own: nothing has been compiled
    ViewState state = startState(makeProceduralScene("tiny"), settingsOf(Filter::Svgf));
    state.resolution = {.followWindow = false, .scale = 1.0f, .fixed = size};
    state.showPasses = true;
    Workbench workbench(shaders, gl, makeProceduralScene("tiny"), state,
                        {folder.path(), folder.path() / "presets"});
    const PassTimings& timings = workbench.timings();
    const auto framesTimed = [&](int frames) {
        const std::size_t before = timings.frames().size();
        for (int i = 0; i < frames; ++i)
            REQUIRE(workbench.advance(0.01, size));
        return timings.frames().size() - before;
    };
    CHECK(framesTimed(1) == 0);
    CHECK(timeText(timings) == "compiling");
    framesTimed(3);
    CHECK(framesTimed(8) == 8);
    const auto slowest = [&] { return std::ranges::max(timings.frames()); };
    const float usual = slowest();
    MESSAGE("the slowest frame: ", usual, " ms");
    // A filter with programs of its own, and the same again.
    chooseFilter(workbench.state, Filter::Asvgf);
    CHECK(framesTimed(1) == 0);
    framesTimed(2);
    chooseFilter(workbench.state, Filter::Svgf);
    CHECK(framesTimed(4) == 4);
    chooseFilter(workbench.state, Filter::Asvgf);
    CHECK(framesTimed(4) == 4);
    MESSAGE("and after two switches: ", slowest(), " ms");
}
