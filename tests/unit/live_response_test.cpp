#include "app/workbench/live_response.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <doctest/doctest.h>

using namespace afterglow;
using doctest::Approx;
using Status = LiveResponse::Status;

namespace {

/// A number in [0, 1) that depends on both in no visible way (a round of splitmix64).
double noise(std::uint64_t seed, std::uint64_t index) {
    std::uint64_t z =
        seed * 0x9e3779b97f4a7c15u + index * 0xd1342543de82ef95u + 0x632be59bd9b4e019u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return double((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/// A pane whose filter is an exponential average that shows `bias` times what it has.
struct Pane {
    double alpha = 1.0, bias = 1.0;
};

/// A light in front of some panes, frame by frame.
struct Bench {
    ProbeLog log;
    std::uint32_t frame = 0;
    double light = 1.0;
    std::vector<Pane> panes;
    std::vector<double> state;
    std::uint64_t seed = 0;
    /// Whether the signal is noisy: 0 or twice the light, at even odds, in each pixel.
    bool noisy = false;
    int pixels = 100;
    std::optional<double> secondLight; ///< at probe B, if it is there
    std::array<bool, kPanes> runs{true, true, true, true};

    explicit Bench(Pane first) : panes{first}, state{light} {}
    Bench(Pane first, Pane second) : panes{first, second}, state{light, light} {}

    ProbeSample rawSample(double mean) const {
        double sum = 0.0;
        for (int i = 0; i < pixels; ++i)
            sum += noisy && noise(seed, std::uint64_t(frame) * 4096 + std::uint64_t(i)) < 0.5
                       ? 0.0
                       : (noisy ? 2.0 * mean : mean);
        const double raw = sum / pixels;
        // Among values that are 0 or 2 mean.
        return {.pixels = std::uint64_t(pixels),
                .rawLit = raw,
                .rawVariance = noisy ? raw * (2.0 * mean - raw) : 0.0};
    }

    void step(std::vector<ProbeMark> marks = {}) {
        ProbeFrame now;
        now.frame = frame;
        now.marks = std::move(marks);
        now.probes[0] = probeBetween({0, 0}, {pixels - 1, 0}, {4096, 1});
        if (secondLight)
            now.probes[1] = probeBetween({0, 0}, {pixels - 1, 0}, {4096, 1});
        ProbeSample sample = rawSample(light);
        for (std::size_t i = 0; i < panes.size(); ++i) {
            now.panes[i] = "filter";
            state[i] += panes[i].alpha * (sample.rawLit - state[i]);
            sample.lit = panes[i].bias * state[i];
            if (!runs[i])
                continue;
            now.samples[0][i] = sample;
            if (secondLight)
                now.samples[1][i] =
                    ProbeSample{.pixels = 4, .lit = *secondLight, .rawLit = *secondLight};
        }
        log.add(now);
        ++frame;
    }
    void run(int frames) {
        for (int i = 0; i < frames; ++i)
            step();
    }
    void change(double to, const std::string& name = "key off") {
        light = to;
        step({{name, true, {}}});
    }
    LiveResponse response(std::size_t pane = 0, std::size_t probe = 0) const {
        return liveResponse(log, probe, pane);
    }
};

void checkNoClaim(const LiveResponse& response) {
    CHECK_FALSE(response.claimed());
    CHECK(response.p.empty());
    CHECK_FALSE(response.t50);
    CHECK_FALSE(response.t90);
    CHECK(response.ghostFrames == 0.0);
}

} // namespace

TEST_CASE(
    "a live exponential average of weight 0.2 is half there in 3 frames and nine tenths in 10") {
    // p after n frames is 1 - 0.8^(n + 1): 0.8^4 < 0.5 < 0.8^3 and 0.8^11 < 0.1 < 0.8^10.
    for (const double to : {0.0, 3.0}) {
        Bench bench(Pane{.alpha = 0.2});
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
    Bench bench(Pane{.alpha = 1.0});
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
    Bench bench(Pane{.alpha = 0.2, .bias = 0.97});
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
        Bench bench(Pane{.alpha = 0.5});
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
    Bench bench(Pane{.alpha = 0.5});
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

TEST_CASE("whatever else happens ends the response") {
    Bench bench(Pane{.alpha = 0.2}, Pane{.alpha = 0.2});
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
    Bench bench(Pane{.alpha = 0.2}, Pane{.alpha = 0.2});
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
    Bench bench(Pane{.alpha = 1.0});
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
    Bench bench(Pane{.alpha = 1.0});
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
        Bench bench(Pane{.alpha = 1.0});
        bench.run(20);
        bench.change(to);
        for (int n = 0; n < 60; ++n) {
            CHECK(bench.response().status == Status::TooSmall);
            checkNoClaim(bench.response());
            bench.step();
        }
    }
    Bench bench(Pane{.alpha = 1.0});
    bench.run(20);
    bench.change(1.025);
    CHECK(bench.response().status == Status::Live);
    Bench dark(Pane{.alpha = 1.0});
    dark.light = dark.state[0] = 0.0;
    dark.run(20);
    dark.change(0.0);
    CHECK(dark.response().status == Status::TooSmall); // black to black
}

TEST_CASE("the target's standard error is what the noise of the signal makes it") {
    // 0 or 2 in each of 100 pixels: a variance of 1 between them, 0.01 between frames.
    Bench bench(Pane{.alpha = 0.2});
    bench.noisy = true;
    bench.run(100);
    bench.change(4.0);
    bench.run(24);
    const LiveResponse r = bench.response();
    CHECK(r.status == Status::Live);
    // 25 frames of sd 0.4; the larger of two estimates, each some 10 % uncertain.
    CHECK(r.targetError > 0.08 * 0.9);
    CHECK(r.targetError < 0.08 * 1.5);
    CHECK(std::abs(r.target - 4.0) < 4.0 * 0.08);
}

TEST_CASE("not one in a thousand looks at noise alone takes it for a step") {
    // An unrelated light, 400 times each, for a box and a single pixel and filters quick and slow.
    struct Kind {
        int pixels;
        double alpha;
    };
    for (const Kind kind : {Kind{100, 0.05}, Kind{100, 0.2}, Kind{100, 1.0}, Kind{1, 0.05},
                            Kind{1, 0.2}, Kind{1, 1.0}}) {
        CAPTURE(kind.pixels);
        CAPTURE(kind.alpha);
        int claims = 0, looks = 0;
        for (std::uint64_t seed = 0; seed < 400; ++seed) {
            Bench bench(Pane{.alpha = kind.alpha});
            bench.noisy = true;
            bench.pixels = kind.pixels;
            bench.seed = seed;
            bench.run(60);
            bench.change(1.0, "unrelated on");
            for (int n = 0; n < 64; ++n) {
                claims += bench.response().claimed();
                ++looks;
                bench.step();
            }
        }
        CHECK(claims <= looks / 1000);
    }
}

TEST_CASE("under noise the measured lag is the true one to a frame or two") {
    int close50 = 0, close90 = 0;
    double ghost = 0.0;
    constexpr int kRuns = 200;
    for (std::uint64_t seed = 0; seed < kRuns; ++seed) {
        Bench bench(Pane{.alpha = 0.2});
        bench.noisy = true;
        bench.pixels = 400;
        bench.seed = seed;
        bench.run(60);
        bench.change(0.0);
        bench.run(64);
        const LiveResponse r = bench.response();
        REQUIRE(r.status == Status::Settled);
        REQUIRE(r.t50);
        REQUIRE(r.t90);
        close50 += std::abs(*r.t50 - 3) <= 1;
        close90 += std::abs(*r.t90 - 10) <= 1;
        ghost += r.ghostFrames / kRuns;
    }
    CHECK(close50 == kRuns);
    CHECK(close90 == kRuns);
    CHECK(ghost == Approx(4.0).epsilon(0.02));
}

TEST_CASE("a single noisy pixel waits until it has frames enough, and then measures") {
    int claims = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        Bench bench(Pane{.alpha = 0.2});
        bench.noisy = true;
        bench.pixels = 1;
        bench.seed = seed;
        bench.run(60);
        bench.change(6.0);
        for (int n = 0; n < 5; ++n) {
            REQUIRE(bench.response().status == Status::Waiting);
            checkNoClaim(bench.response());
            bench.step();
        }
        bench.run(60);
        claims += bench.response().claimed();
    }
    CHECK(claims >= 90); // a step of 5, with an error of 6 / sqrt(66)
}

TEST_CASE("a pane on its way from one event does not answer to another that changes nothing") {
    for (const bool noisy : {false, true}) {
        Bench bench(Pane{.alpha = 0.05});
        bench.noisy = noisy;
        bench.pixels = 400;
        bench.run(60);
        bench.change(0.2);
        bench.run(16);
        bench.change(0.2, "unrelated on");
        for (int n = 0; n < 60; ++n) {
            CHECK(bench.response().event == "unrelated on");
            CHECK(bench.response().status == Status::TooSmall);
            bench.step();
        }
    }
}

TEST_CASE("a pane that hardly moves has not settled: it is measured against the new light") {
    // After 100 frames it is 4.9 % of the way at most, which is not taken for where it will stay.
    for (const double alpha : {0.0, 0.0005}) {
        Bench bench(Pane{.alpha = alpha});
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
    Bench bench(Pane{.alpha = 1.0});
    bench.secondLight = 0.7;
    bench.run(20);
    bench.change(0.0);
    bench.run(60);
    CHECK(bench.response(0, 0).status == Status::Settled);
    CHECK(bench.response(0, 1).status == Status::TooSmall);
    CHECK(bench.response(0, 1).before == Approx(0.7));
    CHECK(bench.response(0, 2).status == Status::Waiting); // there is no such probe
}

TEST_CASE("a pane that appears after the event has nothing to say of it, and of the next it has") {
    Bench bench(Pane{.alpha = 1.0}, Pane{.alpha = 0.5});
    bench.runs[1] = false;
    bench.run(20);
    bench.change(0.0);
    bench.run(5);
    bench.runs[1] = true;
    bench.run(30);
    CHECK(bench.response(0).status == Status::Live);
    CHECK(bench.response(1).status == Status::Waiting);
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
    Bench bench(Pane{.alpha = 0.2});
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
    Bench bench(Pane{.alpha = 1.0});
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
    CHECK(bench.response().status == Status::Waiting);
    CHECK(bench.response().before == 0.0);
    CHECK(bench.response().target == 0.0);
}

TEST_CASE("a response is told in a line") {
    Bench bench(Pane{.alpha = 0.4});
    CHECK(describe(bench.response()) == "no change of light yet");
    bench.run(20);
    CHECK(describe(bench.response()) == "no change of light yet");
    bench.change(0.0);
    CHECK(describe(bench.response()) ==
          "key off: t50 not yet, t90 not yet, 0.6 ghost frames so far (0 frames)");
    bench.step();
    CHECK(describe(bench.response()) ==
          "key off: t50 1, t90 not yet, 1.0 ghost frames so far (1 frame)");
    bench.run(50);
    CHECK(describe(bench.response()) == "key off: t50 1, t90 4, 1.5 ghost frames (settled)");
    bench.change(0.0, "lamp on");
    CHECK(describe(bench.response()) == "lamp on: too small a step to measure here");
    bench.run(20);
    bench.change(1.0, "key on");
    bench.step();
    bench.step({{"camera moved", false, {}}});
    CHECK(describe(bench.response()) ==
          "key on: t50 1, t90 never, 1.0 ghost frames (cut short at 1 frame)");
    bench.change(0.0, "key off"); // straight after a mark: nothing is known of before
    CHECK(describe(bench.response()) == "key off: waiting for more frames");
    bench.step({{"camera moved", false, {}}});
    CHECK(describe(bench.response()) == "key off: not enough frames to measure");
}
