// SPDX-License-Identifier: MIT
// The times of passes that a command reports are those of the frame that it reports.

#include "app/base/output.h"
#include "renderer/scene/procedural.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/sequence.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

using namespace afterglow;
using namespace afterglow::test;

namespace {

/// By pass: whether it ran, frame by frame.
using Ran = std::map<std::string, std::vector<bool>>;

/// Renders these filters one after the other and times their passes, by queries or by the clock.
FrameClock clocked(std::span<const Filter> filters, bool software) {
    GlInfo gl = glInfo(testContext());
    gl.softwareRasterizer = software;
    Renderer renderer(testShaders(), gl);
    renderer.setScene(makeProceduralScene("tiny"));
    renderer.resize({61, 37});
    renderer.timer().setEnabled(true);
    FrameClock clock;
    const Camera camera = cameraAt(renderer.scene(), poseAt(renderer.scene(), 0.0));
    for (std::uint32_t frame = 0; frame < filters.size(); ++frame)
        clock.render(renderer,
                     {.camera = camera, .seconds = 0.0, .frame = frame, .seed = 1, .lights = {}},
                     settingsOf(filters[frame]));
    return clock;
}

Ran passesOf(const FrameClock& clock) {
    Ran ran;
    for (const FrameClock::Pass& pass : clock.passes())
        for (const auto& milliseconds : pass.milliseconds)
            ran[pass.name].push_back(milliseconds.has_value());
    return ran;
}

} // namespace

TEST_CASE("each frame has the times of its own passes, by queries as by the clock") {
    const GlCheck noGlMessages;
    using enum Filter;
    constexpr std::array filters{Asvgf, None, Svgf, Fixed, Asvgf, None, Svgf, Fixed, Asvgf};
    const Ran byClock = passesOf(clocked(filters, true));
    CHECK(passesOf(clocked(filters, false)) == byClock);
    CHECK(byClock.at("lighting") == std::vector<bool>(9, true));
    CHECK(byClock.at("temporal") == std::vector<bool>{1, 0, 1, 1, 1, 0, 1, 1, 1});
    CHECK(byClock.at("lambda") == std::vector<bool>{1, 0, 0, 0, 1, 0, 0, 0, 1});
}

TEST_CASE("a pass that ran in the warm-up alone has no median, and no line in a table") {
    const GlCheck noGlMessages;
    using enum Filter;
    constexpr std::array filters{Asvgf, Svgf, Svgf, Fixed, None, Fixed};
    const FrameClock clock = clocked(filters, true);
    REQUIRE(clock.warmup() == 3);
    const auto described = describe(clock);
    const std::string table = passTable(clock);
    for (const char* name : {"lighting", "temporal", "tone map"}) {
        CAPTURE(name);
        CHECK(described.at("pass_ms_median").at(name) > 0.0);
        CHECK(table.find("    " + std::string(name) + " ") != std::string::npos);
    }
    for (const char* name : {"lambda", "variance"}) {
        CAPTURE(name);
        CHECK(described.at("pass_ms").at(name).size() == filters.size());
        CHECK_FALSE(described.at("pass_ms_median").contains(name));
        CHECK(table.find(name) == std::string::npos);
    }
    CHECK(std::ranges::count(table, '\n') == std::ptrdiff_t(described.at("pass_ms_median").size()));
}
