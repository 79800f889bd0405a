// SPDX-License-Identifier: MIT
// A number in the window belongs to what made it: scene, filter, settings and event.

#include "app/measure/live_response.h"
#include "app/workbench/tour.h"
#include "workbench_bench.h"

#include <algorithm>
#include <fstream>
#include <functional>

using namespace afterglow;
using namespace afterglow::test;

namespace {

LiveResponse responseOf(WorkbenchBench& bench, std::size_t pane) {
    return liveResponse(bench.log(), 0, pane, recordOf(bench.state.panes, pane).settings);
}

/// An experiment of three variants in another scene, size and seed.
std::string threeVariants(const TemporaryFolder& folder) {
    const auto file = folder.path() / "three.json";
    std::ofstream(file) << R"({"name": "three", "scene": "cornell", "size": [48, 27], "frames": 9,
        "seed": 5, "animated": false, "signal": "shadows",
        "variants": ["asvgf", {"name": "fixed-01", "filter": "fixed", "settings": {"alpha": 0.1}},
                     {"name": "fixed-03", "filter": "fixed", "settings": {"alpha": 0.3}}],
        "timeline": [{"frame": 4, "light": "key", "on": false}]})";
    return file.string();
}

} // namespace

TEST_CASE("another filter, parameter, preset or pane has no numbers before the next event") {
    const GlCheck noGlMessages;
    WorkbenchBench bench("tiny", Filter::Svgf);
    setField(bench.state.panes, fieldByKey("signal"), double(Signal::Shadows));
    setProbe(bench.state, 0, probeBetween({0, 0}, {60, 36}, kBenchSize), kBenchSize);
    const auto light = [&] {
        bench.press('1');
        bench.frames(12);
        return responseOf(bench, bench.state.panes.active);
    };
    bench.frames(20);
    REQUIRE(light().claimed());
    struct Change {
        std::string name;
        std::function<void()> make;
    };
    Panes& panes = bench.state.panes;
    for (const Change& change :
         {Change{"filter", [&] { bench.press('F'); }},
          Change{"parameter", [&] { setField(panes, fieldByKey("alpha"), 0.35); }},
          Change{"frame-wide",
                 [&] { setField(panes, fieldByKey("signal"), double(Signal::Both)); }},
          Change{"preset",
                 [&] {
                     FilterSettings other = bench.state.settings();
                     other.denoiser.temporal.alpha = 0.15f;
                     setPane(panes, panes.active, "Mine", other);
                 }},
          Change{"pane", [&] { bench.press('G'); }}}) {
        CAPTURE(change.name);
        change.make();
        const std::size_t pane = panes.active;
        CHECK_FALSE(responseOf(bench, pane).claimed()); // at once
        bench.frames(10);
        const LiveResponse r = responseOf(bench, pane);
        CHECK_FALSE(r.claimed());
        CHECK(statusText(r) == "not measured");
        const auto& frames = bench.log().frames();
        if (change.name != "pane") {
            const ProbeFrame& first = frames[frames.size() - 10];
            REQUIRE(first.marks.size() == 1);
            CHECK(first.marks[0].text.starts_with("pane A: "));
        }
        bench.frames(10);
        CHECK(light().claimed());
    }
}

TEST_CASE("forgotten histories and another seed end what was measured before them") {
    const GlCheck noGlMessages;
    WorkbenchBench bench("tiny", Filter::Svgf);
    setProbe(bench.state, 0, probeBetween({0, 0}, {60, 36}, kBenchSize), kBenchSize);
    bench.frames(5);
    bench.press('H');
    bench.frames(1);
    CHECK(bench.log().frames().back().marks.at(0).text == "histories forgotten");
    bench.state.seed = 3;
    bench.frames(2);
    CHECK(bench.log().frames().size() == 2);
}

TEST_CASE("a stop of the tour begins with nothing measured, also in the scene of the one before") {
    const GlCheck noGlMessages;
    WorkbenchBench bench("cornell");
    const auto& tour = tourStops();
    int sameScene = 0;
    for (std::size_t stop = 0; stop < std::min<std::size_t>(tour.size(), 4); ++stop) {
        sameScene += stop > 0 && tour[stop].scene == tour[stop - 1].scene;
        bench.workbench.enterTourStop(stop, kBenchSize);
        CAPTURE(stop);
        CHECK(bench.state.tourStop == stop);
        CHECK(bench.log().frames().empty());
        for (int i = 0; i < 3; ++i) // a stop may ask for few frames a second
            REQUIRE(bench.workbench.advance(1.0, kBenchSize));
        CHECK(bench.log().frames().size() == 3);
        CHECK(bench.log().frames().front().frame == 0);
        for (const std::size_t pane : shownPanes(bench.state.panes))
            CHECK(responseOf(bench, pane).event.empty());
    }
    CHECK(sameScene > 0);
    bench.workbench.enterTourStop(tour.size(), kBenchSize);
    CHECK_FALSE(bench.state.tourStop);
    CHECK(bench.state.preferences.tourDone);
}

TEST_CASE("an experiment shows its variants alone, and leaving it brings back what was before") {
    const GlCheck noGlMessages;
    WorkbenchBench bench("tiny", Filter::Clamp);
    ViewState& state = bench.state;
    chooseLayout(state.panes, PaneLayout::FourUp);
    choosePane(state.panes, 3);
    setField(state.panes, fieldByKey("alpha"), 0.05);
    setField(state.panes, fieldByKey("aoRadius"), 0.2);
    state.seed = 11;
    state.lights[0].power = 0.5f;
    state.time.animate = false;
    setProbe(state, 1, probeAt({7, 9}, kBenchSize), kBenchSize);
    bench.frames(5);
    state.camera.position.x += 0.01f;
    bench.frames(1);
    const ViewState before = state;

    bench.workbench.open(threeVariants(bench.folder));
    CAPTURE(state.notice.text);
    REQUIRE(state.experiment == "three");
    bench.frames(3);
    CHECK(bench.workbench.imageSize() == glm::ivec2(48, 27));
    CHECK(state.panes.layout == PaneLayout::FourUp);
    CHECK(shownPanes(state.panes) == std::vector<std::size_t>{0, 1, 2});
    CHECK(state.panes.frame.lighting.aoRadius == Settings{}.lighting.aoRadius);
    CHECK(state.panes.frame.lighting.signal == int(Signal::Shadows));
    const ProbeFrame& shown = bench.log().frames().back();
    CHECK(shown.panes[0].settings == "filter=asvgf signal=shadows");
    CHECK(shown.panes[1].title == "fixed-01");
    CHECK(shown.panes[1].settings == "filter=fixed alpha=0.1 signal=shadows");
    CHECK(shown.panes[2].settings == "filter=fixed alpha=0.3 signal=shadows");
    CHECK(shown.panes[3].title.empty());
    CHECK_FALSE(bench.workbench.renderer().ran(3));
    bench.press('4', true); // whatever is done in it
    bench.press('F');
    bench.workbench.open(threeVariants(bench.folder)); // and once more
    bench.frames(2);

    bench.press(Key::Backspace);
    bench.frames(1);
    CHECK(state.experiment.empty());
    CHECK_FALSE(state.time.playing);
    CHECK(bench.workbench.scene().name == "tiny");
    CHECK(bench.workbench.imageSize() == kBenchSize);
    CHECK(state.sceneName == before.sceneName);
    CHECK(state.preferences.lastScene == before.sceneName);
    CHECK(changedPanes(before.panes, state.panes).empty());
    CHECK(state.panes.layout == PaneLayout::FourUp);
    CHECK(shownPanes(state.panes).size() == 4);
    CHECK(state.panes.active == 3);
    CHECK(state.seed == 11);
    CHECK(state.lights == before.lights);
    CHECK(state.lightNames == before.lightNames);
    CHECK(state.camera == before.camera);
    CHECK(state.resolution == before.resolution);
    CHECK(state.probes == before.probes);
    CHECK(state.time.frame == before.time.frame + 1);
    CHECK_FALSE(state.time.animate);
    CHECK(bench.log().frames().size() == 1);
    CHECK(bench.workbench.renderer().ran(3));
}

TEST_CASE("a scene that is opened over an experiment has the panes of before it") {
    const GlCheck noGlMessages;
    WorkbenchBench bench("tiny");
    bench.frames(1);
    const Panes before = bench.state.panes;
    bench.workbench.open(threeVariants(bench.folder));
    bench.frames(1);
    bench.workbench.open("nowhere"); // changes nothing
    CHECK(bench.state.experiment == "three");
    bench.workbench.open("cornell");
    CHECK(bench.state.experiment.empty());
    CHECK(bench.state.sceneName == "cornell");
    CHECK(changedPanes(before, bench.state.panes).empty());
    CHECK(bench.state.panes.count == kFilterStates);
    CHECK(bench.state.resolution.fixed == kBenchSize);
    bench.frames(2);
    CHECK_FALSE(bench.state.time.playing);
}

TEST_CASE("the CSV of an experiment's panes tells their alphas apart") {
    const GlCheck noGlMessages;
    WorkbenchBench bench("tiny");
    bench.workbench.open(threeVariants(bench.folder));
    setProbe(bench.state, 0, probeAround({20, 10}, {48, 27}), {48, 27});
    bench.frames(6);
    bench.press('C', true);
    bench.round();
    const auto csv = bench.workbench.takeCopied();
    REQUIRE(csv);
    CAPTURE(*csv);
    for (const std::string fact :
         {"# scene: three\n# seed: 5\n# size: 48x27\n",
          "# pane B from frame 0: fixed-01: filter=fixed alpha=0.1 signal=shadows\n",
          "# pane C from frame 0: fixed-03: filter=fixed alpha=0.3 signal=shadows\n",
          "# event: frame 4, key off\n", "# result: probe A, pane C, fixed-03, frame 4, key off: "})
        CHECK(csv->find(fact) != std::string::npos);
}
