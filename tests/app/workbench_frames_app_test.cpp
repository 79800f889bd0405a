// SPDX-License-Identifier: MIT
// The workbench without a window: frames, panes, loops, passes and frozen moments, driven by keys.

#include "app/measure/live_response.h"
#include "app/measure/truth.h"
#include "app/scenario/experiment.h"
#include "app/workbench/pointer.h"
#include "renderer/image/image_io.h"
#include "workbench_bench.h"

#include <algorithm>
#include <fstream>

using namespace afterglow;
using namespace afterglow::test;

namespace {

constexpr glm::ivec2 kSize = kBenchSize;

} // namespace

TEST_CASE(
    "when the only light goes out the A-SVGF pane follows at once and the SVGF pane does not") {
    const GlCheck noGlMessages;
    WorkbenchBench bench("tiny");
    setField(bench.state.panes, fieldByKey("signal"), double(Signal::Shadows));
    bench.press('T'); // wipe: A-SVGF and SVGF
    REQUIRE(bench.state.panes.layout == PaneLayout::Wipe);
    setProbe(bench.state, 0, probeBetween({0, 0}, {60, 36}, kSize), kSize);
    bench.frames(20);
    bench.press('1');
    bench.frames(52);

    const ProbeLog& log = bench.log();
    REQUIRE(log.frames().size() == 72);
    CHECK(log.frames()[20].marks.at(0).text.ends_with(" off"));
    CHECK(log.frames()[20].marks.at(0).step);
    const auto lit = [&](std::size_t frame, std::size_t pane) {
        return log.frames()[frame].samples[0][pane]->lit;
    };
    const double end = log.frames()[20].samples[0][0]->rawLit;
    CHECK(end == 0.0);
    for (const std::size_t pane : {0u, 1u}) {
        const double step = lit(19, pane) - end;
        CHECK(step > 0.05);
        CAPTURE(pane);
        CAPTURE((lit(20, pane) - end) / step);
        CHECK(((lit(21, pane) - end) / step < 0.1) == (pane == 0));
    }
    const auto settings = [&](std::size_t pane) {
        return recordOf(bench.state.panes, pane).settings;
    };
    const LiveResponse quick = liveResponse(log, 0, 0, settings(0)),
                       slow = liveResponse(log, 0, 1, settings(1));
    REQUIRE(quick.claimed());
    REQUIRE(slow.claimed());
    CHECK(quick.status == LiveResponse::Status::Settled);
    CHECK(quick.t90 <= 1);
    CHECK(slow.t90 >= 8);
    CHECK(quick.ghostFrames < 0.5);
    CHECK(slow.ghostFrames > 3.0);

    // The same as CSV.
    bench.press('C', true);
    bench.round();
    const auto csv = bench.workbench.takeCopied();
    REQUIRE(csv);
    CHECK(std::ranges::count(*csv, '\n') - std::ranges::count(*csv, '#') == 1 + 2 * 72);
    CHECK(csv->starts_with("# scene: tiny\n# seed: 0\n# size: 61x37\n"));
    CHECK(csv->find("A-SVGF") != std::string::npos);
    CHECK_FALSE(bench.workbench.takeCopied());
    bench.press('E', true);
    bench.round();
    CHECK(std::filesystem::exists(bench.folder.path() / "afterglow-curves-0001.csv"));
}

TEST_CASE("another filter, another pane and another layout clear no history") {
    const GlCheck noGlMessages;
    WorkbenchBench bench("cornell", Filter::Svgf);
    setProbe(bench.state, 0, probeBetween({5, 5}, {55, 32}, kSize), kSize);
    bench.frames(24);
    const auto history = [&](std::size_t pane) {
        const auto& newest = bench.log().frames().back();
        return newest.samples[0][pane] ? newest.samples[0][pane]->history : -1.0;
    };
    CHECK(history(0) > 15.0);
    const double grown = history(0);
    bench.press('F');
    bench.frames(1);
    CHECK(history(0) > grown - 1.0);
    bench.press('T', false, true); // difference
    bench.press('T', false, true); // four up
    REQUIRE(bench.state.panes.layout == PaneLayout::FourUp);
    bench.frames(2);
    for (std::size_t pane = 0; pane < 4; ++pane) {
        CAPTURE(pane);
        if (bench.state.panes.all[pane].settings.filter != Filter::None)
            CHECK(history(pane) > grown - 1.0);
    }
    bench.press('H');
    bench.frames(1);
    CHECK(history(0) == 1.0);
}

TEST_CASE("a loop between two points shows the same bits in every round, with lights and all") {
    const GlCheck noGlMessages;
    WorkbenchBench bench("moving");
    bench.frames(7);
    bench.press('I');
    bench.frames(2);
    bench.press('1');
    bench.frames(3);
    bench.press('O');
    std::vector<Image<glm::u8vec4>> first;
    for (int i = 0; i < 5; ++i) {
        bench.frames(1);
        first.push_back(bench.picture(0));
    }
    CHECK(meanOf(first[4]) < meanOf(first[0]) - 5.0);
    for (int roundOfLoop = 0; roundOfLoop < 2; ++roundOfLoop)
        for (int i = 0; i < 5; ++i) {
            bench.frames(1);
            CAPTURE(i);
            CHECK(differingPixels(bench.picture(0), first[std::size_t(i)]) == 0);
        }
    // The filter is not part of the take.
    cycleFilter(bench.state, 1);
    bench.frames(5);
    CHECK(differingPixels(bench.picture(0), first[4]) > 100);
    bench.press(Key::Backspace);
    CHECK_FALSE(bench.state.lights[0].on);
    CHECK_FALSE(bench.state.time.playing);
    bench.frames(1);

    bench.press('T', true);
    bench.round();
    const auto file = bench.folder.path() / "afterglow-take-0001.json";
    CAPTURE(bench.state.notice.text);
    REQUIRE(std::filesystem::exists(file));
    const Experiment saved = loadExperiment(file.string());
    CHECK(saved.scene == "moving");
    CHECK(saved.timeline.frames() > 5);
}

TEST_CASE("an experiment in the window shows the frames that it measures, bit for bit") {
    const GlCheck noGlMessages;
    WorkbenchBench bench("tiny");
    const std::string file = (bench.folder.path() / "dim.json").string();
    std::ofstream(file) << R"({"name": "dim", "scene": "cornell", "size": [61, 37], "frames": 9,
        "seed": 5, "variants": ["asvgf", "svgf"], "animated": false,
        "timeline": [{"frame": 0, "light": "fill", "on": false},
                     {"frame": 4, "light": "key", "power": 0.5}]})";
    bench.state.wanted.open = file;
    bench.frames(1);
    CAPTURE(bench.state.notice.text);
    CHECK(bench.state.panes.layout == PaneLayout::TwoUp);
    chooseLayout(bench.state.panes, PaneLayout::Single); // alone, as it is measured
    const Experiment experiment = loadExperiment(file);
    const StagedRun run = stagedRun(experiment);
    Renderer judge(testShaders(), glInfo(testContext()));
    judge.setScene(run.scene);
    judge.resize(kSize);
    bench.state.time.resetWanted = true;
    bench.workbench.open(file); // from the start
    chooseLayout(bench.state.panes, PaneLayout::Single);
    bench.state.panes.all[0].settings.denoiser.temporal.alpha = 0.2f;
    for (int frame = 0; frame < 9; ++frame) {
        bench.frames(1);
        judge.render(inputAt(experiment, run.plan, frame), settingsOf(Filter::Asvgf));
        CAPTURE(frame);
        CHECK(differingPixels(bench.picture(0),
                              judge.targets().filters[0].display.read<glm::u8vec4>()) == 0);
    }
    CHECK(bench.log().frames().back().marks.empty());
    CHECK(std::ranges::any_of(bench.log().frames(), [](const ProbeFrame& f) {
        return !f.marks.empty() && f.marks[0].text == "key to 50 %" && f.marks[0].step;
    }));
    const auto& recent = bench.state.preferences.recentFiles;
    CHECK(std::ranges::find(recent, std::filesystem::path(file)) != recent.end());
}

TEST_CASE("stepping goes from pass to pass of one frame and then to the next frame") {
    const GlCheck noGlMessages;
    WorkbenchBench bench("tiny");
    bench.frames(3);
    bench.press('.');
    bench.round();
    CHECK(bench.state.time.paused);
    CHECK(bench.state.shown == Shown{Shown::Kind::Pass, 0});
    const std::uint32_t frame = bench.state.time.frame;
    const std::size_t count = bench.workbench.passes().made().size();
    CHECK(count > 20);
    CHECK(bench.workbench.passes().made().front().pass() == "visibility");
    CHECK(bench.workbench.passes().made().back().pass() == "tone map");
    const auto named = [&](std::string_view pass) {
        return std::ranges::any_of(bench.workbench.passes().made(),
                                   [&](const PassCapture::Made& m) { return m.pass() == pass; });
    };
    CHECK(named("a-trous 5"));
    CHECK(named("temporal"));
    CHECK_FALSE(named("temporal 1"));
    int different = 0;
    Image<glm::u8vec4> before = bench.picture(0);
    for (std::size_t i = 1; i < count; ++i) {
        bench.press('.');
        CHECK_FALSE(bench.round());
        CHECK(bench.state.shown.index == i);
        const auto now = bench.picture(0);
        different += differingPixels(now, before) > 50;
        before = now;
    }
    CHECK(bench.state.time.frame == frame);
    CHECK(different > int(count) / 2);
    // The last image is the picture itself.
    CHECK(differingPixels(
              before,
              bench.workbench.renderer().targets().filters[0].display.read<glm::u8vec4>()) == 0);
    bench.press(',');
    bench.round();
    CHECK(bench.state.shown.index == count - 2);
    bench.press('.');
    bench.round();
    bench.press('.');
    CHECK(bench.round());
    CHECK(bench.state.time.frame == frame + 1);
    CHECK(bench.state.shown.index == 0);
}

TEST_CASE("what passes make does not depend on whether somebody looks") {
    const GlCheck noGlMessages;
    WorkbenchBench watched("tiny"), alone("tiny");
    watched.state.showPasses = watched.state.showInspector = true;
    watched.state.inspected = PanePixel{0, {30, 20}};
    setProbe(watched.state, 0, probeAt({30, 20}, kSize), kSize);
    for (int i = 0; i < 4; ++i) {
        show(watched.state, Shown::Kind::Pass, std::size_t(3 * i));
        watched.frames(1);
        alone.frames(1);
        CHECK(watched.workbench.picture(0));
    }
    show(watched.state, Shown::Kind::Picture);
    CHECK(differingPixels(watched.picture(0), alone.picture(0)) == 0);
    watched.workbench.finishMeasuring();
    REQUIRE(watched.workbench.inspection());
    CHECK(watched.workbench.inspection()->pixel == glm::ivec2(30, 20));
    const auto reasons = watched.workbench.reasons(0);
    REQUIRE(reasons);
    std::uint32_t pixels = 0, strata = 0;
    for (const std::uint32_t n : reasons->history)
        pixels += n;
    for (const std::uint32_t n : reasons->fates)
        strata += n;
    CHECK(pixels > 500);
    CHECK(strata == 21 * 13);
}

TEST_CASE("a frozen moment converges, is compared, and lives on as if nothing had been") {
    const GlCheck noGlMessages;
    WorkbenchBench bench("cornell"), judge("cornell");
    bench.state.oracleSamples = 64;
    for (WorkbenchBench* each : {&bench, &judge}) {
        each->frames(12);
        each->press('1');
        each->frames(1);
    }
    bench.press('U');
    int rounds = 0;
    while (!bench.workbench.oracle().isDone() && rounds++ < 2000)
        CHECK_FALSE(bench.round());
    REQUIRE(bench.workbench.oracle().isDone());
    const auto rmse = bench.workbench.oracleRmse(0);
    REQUIRE(rmse);
    CHECK(*rmse > 0.0);
    CHECK(*rmse < 0.5);
    const std::size_t error = aovs().size();
    for (std::size_t i = error; i < images().size(); ++i) {
        show(bench.state, Shown::Kind::Image, i);
        CAPTURE(images()[i].name);
        CHECK(bench.workbench.legend(0).note.empty());
        CHECK(differingPixels(bench.picture(0), judge.picture(0)) > 500);
    }
    // A range is fitted to what is shown, and more samples are another reference.
    show(bench.state, Shown::Kind::Image, error);
    const ImageDisplay& shown = bench.state.displays[error];
    const ImageDisplay wide = shown;
    bench.state.wanted.fitRange = true;
    bench.round();
    CHECK_FALSE(shown == wide);
    CHECK(shown.low == -shown.high);
    bench.state.oracleSamples = 2;
    bench.round();
    CHECK(bench.workbench.oracle().samples() == 2);
    while (!bench.workbench.oracle().isDone())
        bench.round();
    CHECK(bench.workbench.oracleRmse(0).value() > *rmse);
    bench.press('U');
    CHECK_FALSE(bench.state.time.paused);
    for (WorkbenchBench* each : {&bench, &judge})
        each->frames(2);
    CHECK(differingPixels(bench.picture(0), judge.picture(0)) == 0);
}

TEST_CASE("in the first frame of a loop's round the truth looks back to before the loop") {
    const GlCheck noGlMessages;
    WorkbenchBench bench("tiny");
    bench.state.oracleSamples = 4;
    bench.press('1'); // off
    bench.frames(6);
    bench.press('I');
    bench.frames(2);
    bench.press('1'); // on
    bench.frames(2);
    bench.press('O');
    bench.frames(5); // the first of the second round: dark, after a bright one
    const auto changes = [&] {
        toggleFreeze(bench.state);
        while (!bench.workbench.oracle().isDone())
            bench.round();
        show(bench.state, Shown::Kind::Image, aovs().size() + 2); // ideal lambda
        const double mean = meanOf(bench.picture(0));
        toggleFreeze(bench.state);
        return mean;
    };
    const double inFirst = changes();
    bench.frames(2); // the light goes on in this one
    CHECK(changes() > inFirst + 20.0);
    bench.frames(3); // the first of the third round
    CHECK(changes() == inFirst);
}

TEST_CASE("an inspected pixel is told as it was filtered, whatever the pane is set to since") {
    const GlCheck noGlMessages;
    WorkbenchBench bench("tiny");
    bench.state.showInspector = true;
    bench.state.inspected = PanePixel{0, {30, 20}};
    bench.frames(4);
    bench.press('P');
    const auto groups = [&] { return bench.workbench.inspection()->groups.size(); };
    const std::size_t before = groups();
    chooseFilter(bench.state, Filter::None);
    bench.state.inspected = PanePixel{0, {31, 20}};
    bench.round();
    CHECK(groups() == before);
    bench.press('N');
    bench.round();
    CHECK(groups() < before);
}
