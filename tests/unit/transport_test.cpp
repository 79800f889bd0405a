// SPDX-License-Identifier: MIT
#include "tests/unit/transport_program.h"

#include <cmath>
#include <stdexcept>

#include <doctest/doctest.h>

using namespace afterglow;
using namespace afterglow::test;

TEST_CASE("live play hands on what the person does, with the transport's frame and time") {
    Program program;
    program.live.seconds = 99.0; // not the person's to say
    program.rounds(2);
    program.toggle(1, "fill");
    program.live.camera.position.x = 2.0f;
    program.rounds(2);
    const auto& rendered = program.rendered;
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(rendered[i].frame == i);
        CHECK(rendered[i].given.seconds == double(i) / 60.0);
        CHECK(rendered[i].given.lights[1].on == (i < 2));
        CHECK(rendered[i].given.camera.position.x == (i < 2 ? 0.0f : 2.0f));
        CHECK(rendered[i].given.step == (i == 2));
    }
    CHECK(rendered[2].given.marks == std::vector<std::string>{"fill off"});
    CHECK(program.resets + program.restores + program.checkpoints == 0);
}

TEST_CASE("the time of a fixed frame is its number over the rate, to the last bit") {
    Program program;
    for (int frame = 0; frame < 2000; ++frame)
        program.round();
    for (int frame = 0; frame < 2000; ++frame)
        CHECK(program.rendered[std::size_t(frame)].given.seconds == frame / 60.0);

    program.t.seconds = 0.505; // not on a sixtieth
    program.rounds(2);
    CHECK(program.t.seconds == doctest::Approx(0.505 + 2.0 / 60.0).epsilon(1e-12));
}

TEST_CASE("scene time runs like the clock, but a stall does not make it jump; or it stands") {
    Transport t{.timeStep = TimeStep::WallClock};
    const auto render = [&](double wallSeconds) {
        nextFrame(t, {});
        frameRendered(t, wallSeconds);
        return t.seconds;
    };
    CHECK(render(0.03) == doctest::Approx(0.03));
    CHECK(render(5.0) == doctest::Approx(0.13));
    CHECK(render(-1.0) == doctest::Approx(0.13));
    t.animate = false;
    CHECK(render(0.03) == doctest::Approx(0.13));
    CHECK(t.frame == 4);
}

TEST_CASE("a paused transport renders what it is stepped to, and the very first frame") {
    Program program;
    program.t.paused = true;
    CHECK(program.round());
    CHECK_FALSE(program.round());
    stepOnce(program.t);
    stepOnce(program.t);
    CHECK(program.round());
    CHECK(program.round());
    CHECK_FALSE(program.round());
    stepOnce(program.t);
    togglePause(program.t); // runs again, and forgets the step
    program.rounds(3);
    togglePause(program.t);
    CHECK_FALSE(program.round());
    stepOnce(program.t);
    CHECK(program.round(0.0));
    CHECK(program.t.frame == 7);
}

TEST_CASE("it is known how long the next frame is away, so that nobody oversleeps it") {
    Program program;
    CHECK(secondsUntilFrame(program.t, 0.0) == 0.0);
    program.rounds(1);
    CHECK(secondsUntilFrame(program.t, 0.0) == 0.0);
    for (const int limit : {30, 10, 1}) {
        CAPTURE(limit);
        program.t.frameLimit = limit;
        const double away = secondsUntilFrame(program.t, 0.01);
        CHECK(away > 0.9 / limit - 0.01);
        CHECK(away <= 1.0 / limit - 0.01);
        CHECK(wantsFrame(program.t, 0.01 + away + 1e-9));
        CHECK_FALSE(wantsFrame(program.t, 0.01 + 0.9 * away));
    }
    togglePause(program.t);
    CHECK(std::isinf(secondsUntilFrame(program.t, 100.0)));
    stepOnce(program.t);
    CHECK(secondsUntilFrame(program.t, 0.0) == 0.0);
}

TEST_CASE("in slow motion a frame waits for its time, and a step by hand does not") {
    Transport t;
    CHECK(t.frameLimit == 0);
    CHECK(wantsFrame(t, 0.0));
    faster(t);
    CHECK(t.frameLimit == 0);
    std::vector<int> limits;
    for (int i = 0; i < 6; ++i) {
        slower(t);
        limits.push_back(t.frameLimit);
    }
    CHECK(limits == std::vector<int>{30, 10, 5, 2, 1, 1});
    CHECK(wantsFrame(t, 0.0)); // nothing is to be seen yet
    nextFrame(t, {});
    frameRendered(t, 1.0);
    CHECK_FALSE(wantsFrame(t, 0.9));
    CHECK(wantsFrame(t, 1.0));
    faster(t);
    CHECK_FALSE(wantsFrame(t, 0.45));
    CHECK(wantsFrame(t, 0.5));
    stepOnce(t);
    CHECK(wantsFrame(t, 0.0));

    t = {.frameLimit = 30, .last = SceneFrame{}};
    CHECK(wantsFrame(t, 2.0 / 60.0 - 0.001)); // the second turn of a display at 60 Hz, a bit early
    CHECK_FALSE(wantsFrame(t, 1.0 / 60.0));
}

TEST_CASE("the past is the last 600 frames with what happened in them") {
    Program program;
    for (int frame = 0; frame < 750; ++frame) {
        if (frame == 100 || frame == 700)
            program.toggle(0, "key");
        program.round();
    }
    const auto& past = program.t.past;
    REQUIRE(past.size() == kPast);
    int marked = 0;
    for (std::size_t i = 0; i < kPast; ++i) {
        CHECK(past[i] == program.rendered[150 + i].given);
        CHECK(past[i].frame == 150 + i);
        marked += int(!past[i].marks.empty());
    }
    CHECK(past[550].marks == std::vector<std::string>{"key on"});
    CHECK(past[550].step);
    CHECK(marked == 1);
}

TEST_CASE(
    "what is repeated happens every so many frames, live and recorded, not while a take plays") {
    Program program;
    program.rounds(3);
    CHECK_FALSE(repeatIsDue(program.t));
    startRepeat(program.t, 4);
    program.rounds(10); // 3 .. 12
    std::vector<std::uint32_t> steps;
    for (const Program::Rendered& rendered : program.rendered)
        if (rendered.given.step)
            steps.push_back(rendered.frame);
    CHECK(steps == std::vector<std::uint32_t>{3, 7, 11});

    markIn(program.t);
    program.rounds(4); // 13 .. 16, with a step at 15
    markOut(program.t);
    for (int i = 0; i < 8; ++i) { // twice through the frame in which it was due
        CHECK_FALSE(repeatIsDue(program.t));
        program.rounds(1);
    }
    CHECK(program.between(17, 21) == program.between(13, 17));
    CHECK(program.between(21, 25) == program.between(13, 17));

    program.stop();
    CHECK_FALSE(repeatIsDue(program.t)); // what was played is seen first
    const std::uint32_t left = program.t.frame;
    program.rounds(4);
    CHECK(repeatIsDue(program.t));
    CHECK(program.t.frame == left + 4);

    startRepeat(program.t, 0);
    CHECK_FALSE(repeatIsDue(program.t));
}

TEST_CASE("the repeat goes on after a take whose frame numbers are lower") {
    Program program;
    program.rounds(50);
    startRepeat(program.t, 5);
    program.rounds(1);
    play(program.t, walkOf(4), true);
    program.rounds(2);
    program.stop();
    int due = 0;
    for (int i = 0; i < 20; ++i) {
        due += int(repeatIsDue(program.t));
        program.round();
    }
    CHECK(due == 3); // frames 7, 12 and 17 of 2 .. 21
}

TEST_CASE("for another scene all begins anew, except how time runs") {
    Program program;
    program.recordTenFrames();
    program.t.frameLimit = 5;
    program.t.animate = false;
    program.t.timeStep = TimeStep::WallClock;
    program.t.paused = true;
    startOver(program.t);
    const Transport& t = program.t;
    CHECK(t.frame == 0);
    CHECK(t.seconds == 0.0);
    CHECK((!t.playing && !t.recorded && !t.recording && t.past.empty()));
    CHECK_FALSE((t.restoreWanted || t.resetWanted || t.hasCheckpoint));
    CHECK((t.frameLimit == 5 && !t.animate && t.timeStep == TimeStep::WallClock && t.paused));
    CHECK(wantsFrame(t, 0.0)); // it is to be seen
}

TEST_CASE("a transport is a value: a copy plays on by itself") {
    Program program;
    program.recordTenFrames();
    program.rounds(4);
    Program copy = program;
    program.stop();
    program.rounds(3);
    copy.rounds(10);
    CHECK(copy.t.playing);
    CHECK(copy.between(15, 25) == copy.between(5, 15));
}

TEST_CASE("what the program must not do with a transport is refused") {
    Transport t;
    CHECK_THROWS_AS(frameRendered(t, 0.0), std::logic_error);
    CHECK_THROWS_AS(play(t, {}, true), std::logic_error);
    nextFrame(t, {});
    nextFrame(t, {}); // asking twice is fine
    frameRendered(t, 0.0);
    CHECK(t.frame == 1);
}
