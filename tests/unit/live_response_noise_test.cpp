// SPDX-License-Identifier: MIT
// Live responses measured under noise.

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

namespace {

LightBench noisyBench(double alpha, int pixels, std::uint64_t seed = 0) {
    LightBench bench(PaneModel{.alpha = alpha});
    bench.noisy = true;
    bench.pixels = pixels;
    bench.seed = seed;
    return bench;
}

} // namespace

TEST_CASE("the target's standard error is what the noise of the signal makes it") {
    // 0 or 2 in each of 100 pixels: a variance of 1 between them, 0.01 between frames.
    LightBench bench = noisyBench(0.2, 100);
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
            LightBench bench = noisyBench(kind.alpha, kind.pixels, seed);
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
        LightBench bench = noisyBench(0.2, 400, seed);
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
        LightBench bench = noisyBench(0.2, 1, seed);
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

TEST_CASE("a step of a quarter in one pixel is called too noisy, never too small") {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        LightBench bench = noisyBench(0.2, 1, seed);
        bench.run(60);
        bench.change(0.75);
        for (int n = 0; n < 60; ++n) {
            const LiveResponse r = bench.response();
            CAPTURE(n);
            CHECK(r.status != Status::TooSmall);
            if (r.status == Status::TooNoisy)
                CHECK(describe(r) == "key off: pixel too noisy");
            bench.step();
        }
        CHECK(bench.response().status == Status::TooNoisy);
    }
}

TEST_CASE("a box in which noise hides the step says so, without a word of pixels") {
    LightBench bench = noisyBench(0.2, 9);
    bench.run(60);
    bench.change(0.9);
    bench.run(5);
    CHECK(bench.response().status == Status::TooNoisy);
    CHECK(statusText(bench.response()) == "too noisy");
}
