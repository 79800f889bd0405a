// SPDX-License-Identifier: MIT
// Probes and the inspector are read a frame late, and belong to the frame that they measured.

#include "workbench_bench.h"

#include <algorithm>

using namespace afterglow;
using namespace afterglow::test;

namespace {

constexpr glm::ivec2 kSize = kBenchSize;

/// With two probes, an inspected pixel and two panes.
struct MeasuringBench : WorkbenchBench {
    MeasuringBench() : WorkbenchBench("tiny") {
        setProbe(state, 0, probeBetween({3, 5}, {40, 36}, kSize), kSize);
        setProbe(state, 2, probeAt({30, 20}, kSize), kSize);
        state.showInspector = true;
        state.inspected = PanePixel{0, {30, 20}};
        chooseLayout(state.panes, PaneLayout::TwoUp);
    }

    std::size_t logged() const { return workbench.probeLog().frames().size(); }
};

bool isSame(const ProbeSample& a, const ProbeSample& b) {
    const auto same = [](double x, double y) { return x == y || (x != x && y != y); };
    return a.pixels == b.pixels && same(a.lit, b.lit) && same(a.rawLit, b.rawLit) &&
           same(a.rawVariance, b.rawVariance) && same(a.variance, b.variance) &&
           same(a.lambda, b.lambda) && same(a.alpha, b.alpha) && same(a.history, b.history);
}

bool isSame(const ProbeFrame& a, const ProbeFrame& b) {
    const auto marks = [](const ProbeFrame& f) {
        std::string text;
        for (const ProbeMark& mark : f.marks)
            text += mark.text + "\n";
        return text;
    };
    if (a.frame != b.frame || marks(a) != marks(b) || a.panes != b.panes || a.probes != b.probes)
        return false;
    for (std::size_t probe = 0; probe < kProbes; ++probe)
        for (std::size_t pane = 0; pane < kPanes; ++pane) {
            const auto &x = a.samples[probe][pane], &y = b.samples[probe][pane];
            if (x.has_value() != y.has_value() || (x && !isSame(*x, *y)))
                return false;
        }
    return true;
}

/// All its numbers and words.
std::string textOf(const Workbench& workbench) {
    const auto& inspection = workbench.inspection();
    if (!inspection)
        return "nothing";
    std::string text;
    for (const InspectedGroup& group : inspection->groups)
        for (const InspectedValue& value : group.values) {
            text += value.name + " " + value.value;
            for (const double number : value.numbers)
                text += " " + std::to_string(number);
            text += "\n";
        }
    for (const std::string& sentence : inspection->story)
        text += sentence + "\n";
    for (const std::size_t pane : {0u, 1u})
        if (const auto reasons = workbench.reasons(pane)) {
            for (const std::uint32_t n : reasons->history)
                text += std::to_string(n) + " ";
            for (const std::uint32_t n : reasons->fates)
                text += std::to_string(n) + " ";
        }
    return text;
}

} // namespace

TEST_CASE("what a frame was found to be comes in with the next frame, and is what it was") {
    const GlCheck noGlMessages;
    MeasuringBench bench, judge;
    std::string before = "nothing";
    int different = 0;
    for (std::size_t i = 0; i < 14; ++i) {
        if (i == 6) {
            bench.press('1');
            judge.press('1');
        }
        CHECK(bench.round());
        CHECK(judge.round());
        CAPTURE(i);
        CHECK(bench.logged() == i);
        CHECK(judge.logged() == i);
        CHECK(textOf(bench.workbench) == before);
        judge.workbench.finishMeasuring(); // at once
        REQUIRE(judge.logged() == i + 1);
        different += textOf(judge.workbench) != before;
        before = textOf(judge.workbench);
        CHECK(judge.workbench.probeLog().frames().back().frame == i);
    }
    CHECK(different == 14);
    bench.workbench.finishMeasuring();
    REQUIRE(bench.logged() == 14);
    for (std::size_t i = 0; i < 14; ++i) {
        CAPTURE(i);
        const ProbeFrame& frame = bench.workbench.probeLog().frames()[i];
        CHECK(isSame(frame, judge.workbench.probeLog().frames()[i]));
        CHECK(frame.samples[0][1].has_value());
        CHECK(frame.marks.empty() == (i != 6));
        CHECK((i == 0 || frame.samples[0][0]->rawLit !=
                             bench.workbench.probeLog().frames()[i - 1].samples[0][0]->rawLit));
    }
    bench.workbench.finishMeasuring(); // as often as wanted
    CHECK(bench.logged() == 14);
}

TEST_CASE("curves are whole where time stands still, after a step, and where they are copied") {
    const GlCheck noGlMessages;
    MeasuringBench bench;
    for (int i = 0; i < 5; ++i)
        bench.round();
    CHECK(bench.logged() == 4);
    bench.press('C', true);
    bench.round(); // copies what there is, and renders
    const auto csv = bench.workbench.takeCopied();
    REQUIRE(csv);
    CHECK(csv->find("\n4,") != std::string::npos);
    CHECK(bench.logged() == 5);
    bench.press('P');
    CHECK_FALSE(bench.round());
    CHECK(bench.logged() == 6);
    for (std::size_t i = 7; i < 10; ++i) {
        bench.press('N');
        CHECK(bench.round());
        CHECK(bench.logged() == i);
        CHECK(bench.workbench.probeLog().frames().back().frame == i - 1);
    }
    bench.press('P');
    bench.state.time.frameLimit = 1; // a second until the next one
    CHECK_FALSE(bench.round());
    CHECK(bench.workbench.advance(1.5, kSize));
    CHECK(bench.logged() == 9);
    CHECK_FALSE(bench.round());
    CHECK(bench.logged() == 10);
}

TEST_CASE("an inspected pixel is told at once where time stands still") {
    const GlCheck noGlMessages;
    MeasuringBench bench;
    for (int i = 0; i < 4; ++i)
        bench.round();
    bench.press('P');
    bench.round();
    const auto pixel = [&] { return bench.workbench.inspection()->pixel; };
    REQUIRE(bench.workbench.inspection());
    CHECK(pixel() == glm::ivec2(30, 20));
    bench.state.inspected = PanePixel{1, {7, 9}};
    bench.round();
    CHECK(pixel() == glm::ivec2(7, 9));
    CHECK(bench.workbench.inspection()->state == 1);
    bench.press('N');
    bench.state.inspected = PanePixel{0, {8, 9}};
    bench.round();
    CHECK(pixel() == glm::ivec2(8, 9));
    // The one on its way is not shown where the inspector has been closed.
    bench.press('P');
    bench.round();
    bench.state.showInspector = false;
    bench.round();
    CHECK_FALSE(bench.workbench.inspection());
    bench.round();
    CHECK_FALSE(bench.workbench.inspection());
    CHECK_FALSE(bench.workbench.reasons(0));
}

TEST_CASE("what is on its way survives another size, and nothing survives another scene") {
    const GlCheck noGlMessages;
    MeasuringBench bench, judge;
    for (int i = 0; i < 3; ++i) {
        bench.round();
        judge.round();
        judge.workbench.finishMeasuring();
    }
    bench.state.resolution.fixed = judge.state.resolution.fixed = {40, 90};
    bench.round();
    REQUIRE(bench.logged() == 3);
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(
            isSame(bench.workbench.probeLog().frames()[i], judge.workbench.probeLog().frames()[i]));
    bench.workbench.open("cornell");
    CHECK(bench.logged() == 0);
    bench.workbench.finishMeasuring();
    CHECK(bench.logged() == 0);
    CHECK_FALSE(bench.workbench.inspection());
    bench.round();
    bench.round();
    CHECK(bench.logged() == 1);
    CHECK(bench.workbench.probeLog().frames()[0].frame == 0);
}

TEST_CASE("what frames count is theirs") {
    const GlCheck noGlMessages;
    MeasuringBench bench;
    for (int i = 0; i < 3; ++i) {
        CHECK(bench.workbench.advance(1.0, kSize));
        bench.workbench.finishMeasuring();
        const FrameStats expected = bench.workbench.renderer().readStats();
        CHECK(expected.rays > 0);
        CHECK(bench.workbench.stats().rays == expected.rays);
        CHECK(bench.workbench.stats().gradientSamples == expected.gradientSamples);
        CHECK(bench.workbench.stats().invalidValues == 0);
    }
    CHECK(bench.workbench.stats().gradientSamples > 0);
}
