// SPDX-License-Identifier: MIT
#include "app/workbench/pass_timings.h"

#include <doctest/doctest.h>

using namespace afterglow;

TEST_CASE("a frame's time is a median of the last ones, and passes that are gone are forgotten") {
    PassTimings timings;
    const PassTimings::Row first[] = {{"trace", 12.0}, {"filter", 5.0}};
    const PassTimings::Row usual[] = {{"trace", 10.0}, {"tone map", 1.0}};
    CHECK(timings.frame() == 0.0);
    CHECK(timeText(timings) == "compiling");
    timings.addPasses(first);
    timings.addFrame(400.0);
    for (int i = 0; i < 5; ++i) {
        timings.addPasses(usual);
        timings.addFrame(11.0);
    }
    REQUIRE(timings.passes().size() == 2);
    CHECK(timings.passes()[0].name == "trace");
    CHECK(timings.passes()[0].milliseconds == doctest::Approx((12.0 + 5.0 * 10.0) / 6.0));
    CHECK(timings.passes()[1].name == "tone map");
    CHECK(timings.passes()[1].milliseconds == doctest::Approx(1.0));
    CHECK(timings.frame() == doctest::Approx(11.0));
    CHECK(timeText(timings) == "11.0 ms");
    for (std::size_t i = 0; i < 2 * PassTimings::kFrames; ++i)
        timings.addFrame(double(i));
    CHECK(timings.frames().size() == PassTimings::kFrames);
    CHECK(timings.frames().back() == float(2 * PassTimings::kFrames - 1));
}

TEST_CASE("each pass has its last times, and a new pass begins its own") {
    PassTimings timings;
    const auto add = [&](std::vector<PassTimings::Row> rows) { timings.addPasses(rows); };
    for (int i = 0; i < 4; ++i)
        add({{"trace", double(i)}});
    CHECK(timings.history(0) == std::vector<float>{0.0f, 1.0f, 2.0f, 3.0f});
    add({{"clear", 9.0}, {"trace", 4.0}});
    CHECK(timings.history(0) == std::vector<float>{9.0f});
    CHECK(timings.history(1) == std::vector<float>{0.0f, 1.0f, 2.0f, 3.0f, 4.0f});
    for (std::size_t i = 0; i < 2 * PassTimings::kFrames; ++i)
        add({{"trace", double(i)}});
    CHECK(timings.history(0).size() == PassTimings::kFrames);
    CHECK(timings.history(0).back() == float(2 * PassTimings::kFrames - 1));
}
