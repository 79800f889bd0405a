// SPDX-License-Identifier: MIT
#include "tests/unit/light_bench.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <doctest/doctest.h>

using namespace afterglow;
using namespace afterglow::test;
using doctest::Approx;
using Status = LiveResponse::Status;

TEST_CASE(
    "a live exponential average of weight 0.2 is half there in 3 frames and nine tenths in 10") {
    // p after n frames is 1 - 0.8^(n + 1): 0.8^4 < 0.5 < 0.8^3 and 0.8^11 < 0.1 < 0.8^10.
    for (const double to : {0.0, 3.0}) {
        LightBench bench(PaneModel{.alpha = 0.2});
        bench.run(20);
        bench.change(to);
        double ghost = 0.0;
        for (int n = 0; n < 40; ++n) {
            CAPTURE(n);
            const LiveResponse r = bench.response();
            CHECK(r.status == Status::Live);
            CHECK(r.event == "key off");
            CHECK(r.framesSince == n);
            CHECK_FALSE(r.over);
            CHECK(r.before == Approx(1.0));
            CHECK(r.target == Approx(to));
            REQUIRE(r.p.size() == std::size_t(n + 1));
            CHECK(r.p.back() == Approx(1.0 - std::pow(0.8, n + 1)));
            ghost += std::pow(0.8, n + 1);
            CHECK(r.ghostFrames == Approx(ghost));
            CHECK(r.t50 == (n < 3 ? std::nullopt : std::optional(3)));
            CHECK(r.t90 == (n < 10 ? std::nullopt : std::optional(10)));
            bench.step();
        }
        bench.run(100);
        const LiveResponse r = bench.response();
        CHECK(r.status == Status::Settled);
        CHECK(r.t50 == 3);
        CHECK(r.t90 == 10);
        CHECK(r.ghostFrames == Approx(4.0).epsilon(1e-9)); // (1 - a) / a
    }
}

TEST_CASE("what adapts in the event's own frame has no lag at all") {
    LightBench bench(PaneModel{.alpha = 1.0});
    bench.run(20);
    bench.change(0.25);
    for (int n = 0; n < 60; ++n) {
        const LiveResponse r = bench.response();
        CHECK(r.claimed());
        CHECK(r.t50 == 0);
        CHECK(r.t90 == 0);
        CHECK(r.ghostFrames == 0.0);
        bench.step();
    }
    CHECK(bench.response().status == Status::Settled);
}

TEST_CASE("bias counts as lag while the response is live, and not once it has settled") {
    // It settles at 0.97 of the light. Live, that is 0.03 of ghost in every frame.
    LightBench bench(PaneModel{.alpha = 0.2, .bias = 0.97});
    bench.state[0] = bench.light = 0.0;
    bench.run(20);
    bench.change(2.0);
    bench.run(47);
    const LiveResponse live = bench.response();
    CHECK(live.status == Status::Live);
    CHECK(live.target == Approx(2.0));
    CHECK(live.p.back() == Approx(0.97).epsilon(1e-4));
    double ghost = 0.0;
    for (int n = 0; n < 48; ++n)
        ghost += 1.0 - 0.97 * (1.0 - std::pow(0.8, n + 1));
    CHECK(live.ghostFrames == Approx(ghost));
    CHECK(live.t90 == 11); // 0.97 (1 - 0.8^11) = 0.887 < 0.9 < 0.97 (1 - 0.8^12) = 0.903

    bench.step();
    const LiveResponse settled = bench.response();
    CHECK(settled.status == Status::Settled);
    CHECK(settled.framesSince == 48);
    double level = 0.0; // of frames 33 to 48
    for (int n = 33; n <= 48; ++n)
        level += 1.94 * (1.0 - std::pow(0.8, n + 1)) / 16.0;
    CHECK(settled.target == Approx(level).epsilon(1e-12));
    CHECK(settled.t50 == 3);
    CHECK(settled.t90 == 10);
    CHECK(settled.ghostFrames == Approx(4.0).epsilon(1e-2)); // the level is 2e-4 short of its end
}

TEST_CASE("a response that the next event cuts short is settled from 24 frames on") {
    for (const int length : {12, 23, 24, 40}) {
        CAPTURE(length);
        LightBench bench(PaneModel{.alpha = 0.5});
        bench.run(20);
        bench.change(0.0, "key off");
        bench.run(length - 1);
        CHECK(bench.response().status == Status::Live); // nothing is known of what comes
        bench.change(1.0, "key on");
        const LiveResponse off = responseTo(bench.log, 0, 0, 20);
        CHECK(off.event == "key off");
        CHECK(off.over);
        CHECK(off.framesSince == length - 1);
        CHECK(off.status == (length < 24 ? Status::Live : Status::Settled));
        CHECK(off.p.size() == std::size_t(length));
        CHECK(off.t90 == 3); // 0.5^4 < 0.1 < 0.5^3
        const LiveResponse on = bench.response();
        CHECK(on.event == "key on");
        CHECK(on.status == Status::Live);
        CHECK(on.framesSince == 0);
        CHECK(on.target == Approx(1.0));
    }
}

TEST_CASE("an event in the wake of another is measured from the level that it finds") {
    // Off, and on again 3 frames later: before is the mean of the two frames between the events.
    LightBench bench(PaneModel{.alpha = 0.5});
    bench.run(20);
    bench.change(0.0, "key off");
    bench.run(2);
    bench.change(1.0, "key on");
    bench.run(20);
    const LiveResponse r = bench.response();
    CHECK(r.event == "key on");
    const double before = 0.5 * (0.25 + 0.125);
    CHECK(r.before == Approx(before));
    CHECK(r.target == Approx(1.0));
    // 0.125 is left when the light returns.
    CHECK(r.p[0] == Approx((1.0 - 0.5 * 0.875 - before) / (1.0 - before)));
    CHECK(r.t90 == 3); // (1 - 0.875 * 0.5^4) is 0.933 of the way from before; 0.5^3: 0.865
}

TEST_CASE("a response is that of the settings with which it was measured, and of no other") {
    LightBench bench(PaneModel{.alpha = 0.2}, PaneModel{.alpha = 0.5});
    bench.settings = {"filter=svgf", "filter=fixed", "", ""};
    bench.run(20);
    bench.change(0.0);
    bench.run(9);
    CHECK(bench.response(0).t50 == 3);
    for (const std::string other : {"filter=clamp", "filter=svgf alpha=0.1"}) {
        bench.settings[0] = other; // asked for, and not rendered yet
        const auto checkOther = [&] {
            const LiveResponse r = bench.response(0);
            CHECK(r.status == Status::NotMeasured);
            CHECK(describe(r) == "key off: not measured");
            checkNoClaim(r);
        };
        checkOther();
        bench.run(30);
        checkOther();
    }
    CHECK(bench.response(1).status == Status::Settled); // the other pane's goes on
    CHECK(bench.response(1).framesSince == 69);
    bench.settings[0] = "filter=svgf"; // its own again, as far as they were measured
    bench.step();
    const LiveResponse own = bench.response(0);
    CHECK(own.framesSince == 9);
    CHECK(own.over);
    CHECK(describe(own) == "key off: t50 3, t90 > 9, > 3.6 ghost frames (cut short)");
    bench.settings[0] = "filter=clamp";
    bench.run(20);
    bench.change(1.0, "key on");
    bench.run(10);
    CHECK(bench.response(0).claimed());
    CHECK(bench.response(0).event == "key on");
}

TEST_CASE("whatever else happens ends the response") {
    LightBench bench(PaneModel{.alpha = 0.2}, PaneModel{.alpha = 0.2});
    bench.run(20);
    bench.change(0.0);
    bench.run(9);
    bench.step({{"camera moved", false, {}}});
    bench.run(5);
    for (const std::size_t pane : {0, 1}) {
        const LiveResponse r = bench.response(pane);
        CHECK(r.event == "key off");
        CHECK(r.over);
        CHECK(r.framesSince == 9);
        CHECK_FALSE(r.t90);
    }
    // What concerns one pane does not end the other's.
    bench.run(30);
    bench.change(1.0, "key on");
    bench.run(4);
    bench.step({{"pane B: svgf", false, 1}});
    bench.run(10);
    CHECK(bench.response(0).framesSince == 15);
    CHECK_FALSE(bench.response(0).over);
    CHECK(bench.response(1).framesSince == 4);
    CHECK(bench.response(1).over);
}

TEST_CASE("a change of light that comes with something else is no step") {
    LightBench bench(PaneModel{.alpha = 0.2}, PaneModel{.alpha = 0.2});
    bench.run(20);
    bench.light = 0.0;
    bench.step({{"key off", true, {}}, {"pane B: svgf", false, 1}});
    bench.run(10);
    CHECK(bench.response(0).status == Status::Live);
    CHECK(bench.response(0).event == "key off");
    checkNoClaim(bench.response(1));
    CHECK(bench.response(1).event.empty());
    bench.run(20);
    bench.light = 1.0;
    bench.step({{"key on", true, {}}, {"fill on", true, {}}}); // two lights are one step
    CHECK(bench.response(0).event == "key on, fill on");
    CHECK(bench.response(0).status == Status::Live);
}

TEST_CASE("a jump of the frame number separates what is before it from what comes after") {
    LightBench bench(PaneModel{.alpha = 1.0});
    bench.run(20);
    bench.change(0.0);
    bench.run(5);
    bench.frame = 3; // back to the start of a loop
    bench.run(4);
    const LiveResponse r = bench.response();
    CHECK(r.framesSince == 5);
    CHECK(r.over);
    bench.frame = 3;
    bench.change(1.0, "key on");
    bench.run(10);
    CHECK(bench.response().event == "key on");
    checkNoClaim(bench.response()); // of the light before the jump nothing is known here
    CHECK(bench.response().status == Status::Waiting);
}

TEST_CASE("a live time is withdrawn when the response falls back") {
    LightBench bench(PaneModel{.alpha = 1.0});
    bench.run(20);
    bench.change(0.0);
    bench.run(2);
    CHECK(bench.response().t90 == 0);
    bench.panes[0].alpha = 0.0;
    bench.state[0] = 0.3; // the old light comes back into the pane
    bench.step();
    CHECK(bench.response().t50 == 0);
    CHECK_FALSE(bench.response().t90);
    bench.state[0] = 0.0;
    bench.step();
    CHECK(bench.response().t90 == 4);
}

TEST_CASE("where the light does not change by 2 % nothing is claimed") {
    for (const double to : {1.0, 1.015, 0.985}) {
        LightBench bench(PaneModel{.alpha = 1.0});
        bench.run(20);
        bench.change(to);
        for (int n = 0; n < 60; ++n) {
            CHECK(bench.response().status == Status::TooSmall);
            checkNoClaim(bench.response());
            bench.step();
        }
    }
    LightBench bench(PaneModel{.alpha = 1.0});
    bench.run(20);
    bench.change(1.025);
    CHECK(bench.response().status == Status::Live);
    LightBench dark(PaneModel{.alpha = 1.0});
    dark.light = dark.state[0] = 0.0;
    dark.run(20);
    dark.change(0.0);
    CHECK(dark.response().status == Status::TooSmall); // black to black
}

TEST_CASE("a pane on its way from one event does not answer to another that changes nothing") {
    for (const bool noisy : {false, true}) {
        LightBench bench(PaneModel{.alpha = 0.05});
        bench.noisy = noisy;
        bench.pixels = 400;
        bench.run(60);
        bench.change(0.2);
        bench.run(16);
        bench.change(0.2, "unrelated on");
        for (int n = 0; n < 60; ++n) {
            CHECK(bench.response().event == "unrelated on");
            checkNoClaim(bench.response());
            if (!noisy)
                CHECK(bench.response().status == Status::TooSmall);
            bench.step();
        }
    }
}

TEST_CASE("a pane that hardly moves has not settled: it is measured against the new light") {
    // After 100 frames it is 4.9 % of the way at most, which is not taken for where it will stay.
    for (const double alpha : {0.0, 0.0005}) {
        LightBench bench(PaneModel{.alpha = alpha});
        bench.run(20);
        bench.change(0.0);
        bench.run(100);
        const LiveResponse r = bench.response();
        CHECK(r.status == Status::Live);
        CHECK(r.target == 0.0);
        CHECK_FALSE(r.t50);
        CHECK(r.p.back() == Approx(1.0 - std::pow(1.0 - alpha, 101)));
    }
}

TEST_CASE("probes are measured apart") {
    LightBench bench(PaneModel{.alpha = 1.0});
    bench.secondLight = 0.7;
    bench.run(20);
    bench.change(0.0);
    bench.run(60);
    CHECK(bench.response(0, 0).status == Status::Settled);
    CHECK(bench.response(0, 1).status == Status::TooSmall);
    CHECK(bench.response(0, 1).before == Approx(0.7));
    CHECK(bench.response(0, 2).status == Status::NotMeasured); // there is no such probe
}

TEST_CASE("a pane that appears after the event has nothing to say of it, and of the next it has") {
    LightBench bench(PaneModel{.alpha = 1.0}, PaneModel{.alpha = 0.5});
    bench.runs[1] = false;
    bench.run(20);
    bench.change(0.0);
    bench.run(5);
    bench.runs[1] = true;
    bench.run(30);
    CHECK(bench.response(0).status == Status::Live);
    CHECK(bench.response(1).status == Status::NotMeasured);
    checkNoClaim(bench.response(1));
    bench.change(1.0, "key on");
    bench.run(30);
    CHECK(bench.response(1).status == Status::Live);
    CHECK(bench.response(1).t90 == 3);
    // And one that leaves keeps what it has shown.
    bench.runs[1] = false;
    bench.run(5);
    CHECK(bench.response(1).framesSince == 30);
    CHECK(bench.response(1).over);
    CHECK(bench.response(0).framesSince == 35);
}

TEST_CASE("an event that has left the log is forgotten, and so is one without a frame before it") {
    LightBench bench(PaneModel{.alpha = 0.2});
    bench.run(20);
    bench.change(0.0);
    bench.run(598);
    CHECK(bench.log.frames().size() == ProbeLog::kFrames);
    CHECK(bench.response().status == Status::Settled); // one frame before it is left
    CHECK(bench.response().t90 == 10);
    bench.step();
    CHECK(bench.response().event == "key off");
    CHECK(bench.response().status == Status::Waiting);
    checkNoClaim(bench.response());
    bench.step();
    CHECK(bench.response().event.empty());
    checkNoClaim(bench.response());
    bench.change(1.0, "key on"); // and the ring goes on
    bench.run(50);
    CHECK(bench.response().t90 == 10);
}

TEST_CASE("a picture that is not a number ends the response, and no number of it is one") {
    LightBench bench(PaneModel{.alpha = 1.0});
    bench.run(20);
    bench.change(0.0);
    bench.run(5);
    bench.state[0] = std::numeric_limits<double>::quiet_NaN();
    bench.run(60);
    const LiveResponse r = bench.response();
    CHECK(r.framesSince == 5);
    CHECK(r.over);
    CHECK(r.t90 == 0);
    CHECK(std::isfinite(r.before));
    CHECK(std::isfinite(r.target));
    CHECK(std::isfinite(r.targetError));
    CHECK(std::isfinite(r.ghostFrames));
    CHECK(std::ranges::all_of(r.p, [](double value) { return std::isfinite(value); }));
    // Nothing is known of what comes after it either.
    bench.change(1.0, "key on");
    CHECK(bench.response().status == Status::NotMeasured);
    CHECK(bench.response().before == 0.0);
    CHECK(bench.response().target == 0.0);
}

TEST_CASE("a response is described in a line") {
    LightBench bench(PaneModel{.alpha = 0.4});
    CHECK(describe(bench.response()) == "no change of light yet");
    bench.run(20);
    CHECK(describe(bench.response()) == "no change of light yet");
    bench.change(0.0);
    CHECK(describe(bench.response()) ==
          "key off: t50 not yet, t90 not yet, 0.6 ghost frames so far (live, 0)");
    bench.step();
    CHECK(describe(bench.response()) ==
          "key off: t50 1, t90 not yet, 1.0 ghost frames so far (live, 1)");
    bench.run(50);
    CHECK(describe(bench.response()) == "key off: t50 1, t90 4, 1.5 ghost frames (settled)");
    bench.change(0.0, "lamp on");
    CHECK(describe(bench.response()) == "lamp on: step too small");
    bench.run(20);
    bench.change(1.0, "key on");
    bench.step();
    bench.step({{"camera moved", false, {}}});
    CHECK(describe(bench.response()) == "key on: t50 1, t90 > 1, > 1.0 ghost frames (cut short)");
    bench.change(0.0, "key off"); // straight after a mark: nothing is known of before
    CHECK(describe(bench.response()) == "key off: measuring");
    bench.step({{"camera moved", false, {}}});
    CHECK(describe(bench.response()) == "key off: not measured");
}
