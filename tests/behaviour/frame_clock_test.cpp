// The times of passes that a command reports are those of the frame that it reports.

#include "app/experiment/output.h"
#include "renderer/scene/procedural.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/sequence.h"

#include <doctest/doctest.h>

#include <array>
#include <map>

using namespace afterglow;
using namespace afterglow::test;

namespace {

/// By pass: whether it ran, frame by frame.
using Ran = std::map<std::string, std::vector<bool>>;

/// Another filter in every frame, by queries or by the clock.
Ran passesOf(bool software) {
    GlInfo gl = glInfo(testContext());
    gl.softwareRasterizer = software;
    Renderer renderer(testShaders(), gl);
    renderer.setScene(makeProceduralScene("tiny"));
    renderer.resize({61, 37});
    renderer.timer().setEnabled(true);
    FrameClock clock;
    const Camera camera = cameraAt(renderer.scene(), poseAt(renderer.scene(), 0.0));
    constexpr std::array filters{Filter::Asvgf, Filter::None, Filter::Svgf, Filter::Fixed};
    for (std::uint32_t frame = 0; frame < 9; ++frame)
        clock.render(renderer,
                     {.camera = camera, .seconds = 0.0, .frame = frame, .seed = 1, .lights = {}},
                     settingsOf(filters[frame % filters.size()]));
    Ran ran;
    for (const FrameClock::Pass& pass : clock.passes())
        for (const auto& milliseconds : pass.milliseconds)
            ran[pass.name].push_back(milliseconds.has_value());
    return ran;
}

} // namespace

TEST_CASE("each frame has the times of its own passes, by queries as by the clock") {
    const GlCheck noGlMessages;
    const Ran byClock = passesOf(true), byQueries = passesOf(false);
    CHECK(byQueries == byClock);
    CHECK(byClock.at("lighting") == std::vector<bool>(9, true));
    CHECK(byClock.at("temporal") == std::vector<bool>{1, 0, 1, 1, 1, 0, 1, 1, 1});
    CHECK(byClock.at("lambda") == std::vector<bool>{1, 0, 0, 0, 1, 0, 0, 0, 1});
}
