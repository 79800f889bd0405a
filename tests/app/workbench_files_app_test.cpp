// SPDX-License-Identifier: MIT
// The workbench without a window: pictures, files and presets, driven by keys.

#include "app/measure/live_response.h"
#include "app/scenario/experiment.h"
#include "app/scenario/run_plan.h"
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

TEST_CASE("files that are no scenes and no experiments are told and change nothing") {
    const GlCheck noGlMessages;
    WorkbenchBench bench("tiny");
    bench.frames(2);
    const auto before = bench.picture(0);
    std::ofstream(bench.folder.path() / "bad.json") << "{\"name\": ";
    std::ofstream(bench.folder.path() / "bad.glb") << "no";
    for (const std::string name : {"bad.json", "bad.glb", "missing.gltf"}) {
        CAPTURE(name);
        bench.workbench.open((bench.folder.path() / name).string());
        CHECK(bench.state.notice.isError);
        CHECK(bench.state.notice.text.find(name) != std::string::npos);
        CHECK(bench.workbench.scene().name == "tiny");
        CHECK(differingPixels(bench.picture(0), before) == 0);
    }
    bench.workbench.open("nowhere");
    CHECK(bench.state.notice.isError);
    bench.frames(1);
    bench.workbench.open("cornell");
    CHECK(bench.workbench.scene().name == "cornell");
    CHECK(bench.state.lightNames.size() == 2);
    CHECK(bench.workbench.picture(0) == nullptr);
    bench.frames(1);
}

TEST_CASE("pictures, images of the frame and recordings are files") {
    const GlCheck noGlMessages;
    WorkbenchBench bench("tiny");
    chooseLayout(bench.state.panes, PaneLayout::FourUp);
    bench.frames(2);
    bench.press(Key::F12);
    bench.round();
    const auto whole = readPng(bench.folder.path() / "afterglow-0001.png");
    CHECK(whole.size() == 2 * kSize);
    bench.press('T'); // difference
    bench.press('T'); // single
    bench.press(Key::F12, true);
    bench.round();
    const auto images = bench.folder.path() / "afterglow-images-0001";
    CHECK(std::filesystem::exists(images / "picture.png"));
    CHECK(std::filesystem::exists(images / "lambda.exr"));
    bench.state.recordFrames = 3;
    bench.press(Key::F9);
    bench.frames(5);
    CHECK_FALSE(bench.workbench.recorder().isRecording());
    CHECK(std::filesystem::exists(bench.folder.path() / "afterglow-0001" / "frame_00002.png"));
    CHECK_FALSE(
        std::filesystem::exists(bench.folder.path() / "afterglow-0001" / "frame_00003.png"));
    const auto recorded = readPng(bench.folder.path() / "afterglow-0001" / "frame_00002.png");
    CHECK(recorded.size() == kSize);
}

TEST_CASE("a pane that is shown while time stands still has no picture before the next frame") {
    const GlCheck noGlMessages;
    WorkbenchBench bench("tiny");
    bench.frames(2);
    bench.press('P');
    chooseLayout(bench.state.panes, PaneLayout::TwoUp);
    CHECK_FALSE(bench.round());
    CHECK(bench.workbench.picture(0));
    CHECK(bench.workbench.picture(1) == nullptr);
    CHECK_FALSE(bench.workbench.legend(1).note.empty());
    bench.press(Key::F12);
    bench.round();
    const auto half = readPng(bench.folder.path() / "afterglow-0001.png");
    REQUIRE(half.size() == glm::ivec2(2 * kSize.x, kSize.y));
    CHECK(half({30, 20}) != glm::u8vec4(0, 0, 0, 255));
    CHECK(half({kSize.x + 30, 20}) == glm::u8vec4(0, 0, 0, 255));
    chooseLayout(bench.state.panes, PaneLayout::Difference);
    bench.round();
    CHECK(bench.workbench.picture(0) == nullptr);
    bench.press(Key::F12);
    bench.round(); // nothing to be saved is no fault
    bench.press('N');
    CHECK(bench.round());
    CHECK(bench.workbench.picture(0));
}

TEST_CASE("presets go from pane to pane through the clipboard and into files") {
    const GlCheck noGlMessages;
    WorkbenchBench bench("tiny");
    setField(bench.state.panes, fieldByKey("alpha"), 0.05);
    bench.press('C', true, true);
    bench.round();
    const auto text = bench.workbench.takeCopied();
    REQUIRE(text);
    choosePane(bench.state.panes, 2);
    REQUIRE(bench.state.settings().filter != Filter::Asvgf);
    bench.workbench.paste(*text);
    CHECK(bench.state.settings().filter == Filter::Asvgf);
    CHECK(bench.state.settings().denoiser.temporal.alpha == 0.05f);
    bench.workbench.paste(R"({"name": "x", "description": "d", "source": "s",
        "filter": "asvgf", "settings": {"alhpa": 0.1}})");
    CHECK(bench.state.notice.isError);
    CHECK(bench.state.notice.text.find("alhpa") != std::string::npos);
    CHECK(bench.state.settings().denoiser.temporal.alpha == 0.05f);
    bench.state.wanted.savePreset = "mine";
    bench.round();
    CAPTURE(bench.state.notice.text);
    CHECK(std::filesystem::exists(bench.folder.path() / "presets" / "mine.json"));
    REQUIRE(bench.workbench.presets().find("mine"));
    bench.state.wanted.savePreset = "paper"; // built in
    bench.round();
    CHECK(bench.state.notice.isError);
    bench.state.wanted.removePreset = "mine";
    bench.round();
    CHECK_FALSE(bench.state.notice.isError);
    CHECK(bench.state.notice.text == "Removed the preset mine");
    CHECK(bench.workbench.presets().find("mine") == nullptr);
    CHECK_FALSE(std::filesystem::exists(bench.folder.path() / "presets" / "mine.json"));
}

TEST_CASE("a difference of a filter with itself is black, and of two filters it is not") {
    const GlCheck noGlMessages;
    WorkbenchBench bench("cornell");
    bench.state.panes.gain = 64.0f;
    copyPane(bench.state.panes, 0, 1);
    chooseLayout(bench.state.panes, PaneLayout::Difference);
    bench.frames(4);
    CHECK(meanOf(bench.picture(0)) < 1.0);
    chooseFilter(bench.state, Filter::Fixed);
    bench.frames(2);
    const double picture = meanOf(bench.picture(0));
    CHECK(picture > 10.0);
    // Of an image behind the picture, with its sign: gray is no difference.
    const auto all = aovs();
    const auto showNamed = [&](std::string_view name) {
        show(bench.state, Shown::Kind::Image,
             std::size_t(std::ranges::find(all, name, &AovInfo::name) - all.begin()));
        bench.frames(1);
        CHECK(bench.workbench.picture(0));
        return bench.workbench.legend(0);
    };
    const PictureLegend history = showNamed("history");
    CHECK(history.name == "difference of history");
    CHECK(history.note.empty());
    REQUIRE(history.display);
    CHECK(history.display->map == gpu::kMapSigned);
    CHECK(history.display->low == -history.display->high);
    CHECK(history.display->high == doctest::Approx(127.0 / 64.0)); // of 1 to 128, at gain 64
    // What holds names and not numbers is left alone.
    const PictureLegend instance = showNamed("instance");
    CHECK_FALSE(instance.note.empty());
    CHECK(instance.display->map == gpu::kMapRadiance);
}
