// SPDX-License-Identifier: MIT
// Takes: records between two points, and what is played.

#include "tests/unit/transport_program.h"

#include <stdexcept>

#include <doctest/doctest.h>

using namespace afterglow;
using namespace afterglow::test;

TEST_CASE("between the in and the out point every round has the same bits as the first time") {
    Program program;
    program.recordTenFrames();
    CHECK(program.checkpoints == 1);
    CHECK(program.t.restoreWanted);
    CHECK(program.t.frame == 5);
    CHECK(program.t.seconds == 5.0 / 60.0);
    REQUIRE(program.t.recorded);
    CHECK(program.t.recorded->name == "take-1");
    CHECK(program.t.recorded->frames.front().frame == 5);
    CHECK(program.t.recorded->frames.size() == 10);

    program.toggle(1, "fill"); // does not count now
    program.live.camera.position.x = -7.0f;
    program.rounds(35);
    CHECK(program.restores == 4);
    const auto recorded = program.between(5, 15);
    CHECK(recorded[4].given.marks == std::vector<std::string>{"key off"});
    for (std::size_t first = 15; first < 45; first += 10)
        CHECK(program.between(first, first + 10) == recorded);
    CHECK(program.between(45, 50) == program.between(5, 10)); // and so on
    CHECK(program.resets == 0);
    CHECK(program.checkpoints == 1);
}

TEST_CASE("rounds are alike with the clock's uneven time, too") {
    Program program;
    program.t.timeStep = TimeStep::WallClock;
    markIn(program.t);
    for (const double wall : {0.011, 0.037, 0.5, 0.02})
        program.round(wall);
    markOut(program.t);
    for (const double wall : {0.1, 0.01, 0.03, 0.07, 0.02, 0.01, 0.03, 0.04})
        program.round(wall);
    CHECK(program.between(4, 8) == program.between(0, 4));
    CHECK(program.between(8, 12) == program.between(0, 4));
}

TEST_CASE("an out point without a record does nothing") {
    Program program;
    program.rounds(3);
    markOut(program.t);
    CHECK_FALSE(program.t.playing);
    markIn(program.t);
    markOut(program.t); // no frame yet
    CHECK_FALSE(program.t.playing);
    CHECK(program.t.recording);
    program.rounds(1);
    CHECK(program.t.frame == 4);
    markOut(program.t);
    CHECK(program.t.frame == 3);
    program.rounds(3);
    CHECK(program.t.frame == 3);
}

TEST_CASE("a second in point begins the record anew") {
    Program program;
    program.rounds(2);
    markIn(program.t);
    program.rounds(5);
    markIn(program.t);
    program.rounds(3);
    markOut(program.t);
    CHECK(program.checkpoints == 2);
    CHECK(program.t.recorded->frames.front().frame == 7);
    program.rounds(3);
    CHECK(program.between(10, 13) == program.between(7, 10));
}

TEST_CASE("who leaves a loop goes on from there, with its camera and lights and histories") {
    Program program;
    program.recordTenFrames();
    program.live.lights[0].on = true; // pressed while it plays
    program.rounds(17);               // one round and seven frames
    CHECK(program.t.frame == 12);
    program.stop();
    CHECK_FALSE(program.live.lights[0].on); // as the last frame had it
    CHECK(program.live.camera.position.x == 3.0f);
    CHECK(program.t.frame == 12);
    CHECK(program.t.seconds == 12.0 / 60.0);
    program.rounds(20);
    CHECK(program.restores == 2);
    CHECK(program.t.frame == 32);
    // Bit for bit what had been seen the first time, as nothing was done differently since.
    CHECK(program.between(32, 35) == program.between(12, 15));
    CHECK_FALSE(stopPlaying(program.t));
}

TEST_CASE("who leaves a loop before its next round has begun goes on after the last one") {
    Program program;
    program.recordTenFrames();
    const std::string histories = program.histories;
    program.stop();
    CHECK(program.t.frame == 15);
    CHECK(program.t.seconds == 15.0 / 60.0);
    CHECK_FALSE(program.t.restoreWanted);
    program.rounds(1);
    CHECK(program.restores == 0);
    CHECK(program.rendered.back().frame == 15);

    replay(program.t);
    program.rounds(10); // exactly one round
    program.stop();
    CHECK(program.t.frame == 15);
    CHECK(program.histories == histories);
    program.rounds(1);
    CHECK(program.rendered.back() == program.rendered[15]);
}

TEST_CASE("a record is played again from its checkpoint after the loop was left") {
    Program program;
    program.recordTenFrames();
    program.rounds(13);
    program.stop();
    program.rounds(8);
    program.t.paused = true;
    replay(program.t);
    CHECK_FALSE(program.t.paused);
    const std::size_t first = program.rendered.size();
    program.rounds(20);
    CHECK(program.between(first, first + 10) == program.between(5, 15));
    CHECK(program.between(first + 10, first + 20) == program.between(5, 15));

    Program empty;
    replay(empty.t);
    CHECK_FALSE(empty.t.playing);
}

TEST_CASE("without its checkpoint a record is played without histories, each round alike") {
    Program program;
    program.recordTenFrames();
    program.rounds(3);
    checkpointLost(program.t);
    program.rounds(7);
    const std::size_t first = program.rendered.size();
    program.rounds(20);
    CHECK(program.restores == 1);
    CHECK(program.resets == 2);
    CHECK(program.between(first, first + 10) == program.between(first + 10, first + 20));
    CHECK(program.rendered[first].given == program.rendered[5].given);
    CHECK(program.rendered[first].picture != program.rendered[5].picture);

    program.stop();
    replay(program.t);
    CHECK(program.t.resetWanted);
    CHECK_FALSE(program.t.restoreWanted);

    Program early; // lost after the in point was set, before the copy was made
    early.rounds(2);
    markIn(early.t);
    checkpointLost(early.t);
    early.rounds(2);
    markOut(early.t);
    CHECK(early.t.restoreWanted);
    Program late; // lost at the moment at which it was to be used
    late.recordTenFrames();
    checkpointLost(late.t);
    CHECK(late.t.resetWanted);
    CHECK_FALSE(late.t.restoreWanted);
}

TEST_CASE("a take is played from nothing, and again from nothing if it loops") {
    Program program;
    program.rounds(7);
    const Take take = walkOf(5, 40);
    play(program.t, take, true);
    CHECK(program.t.resetWanted);
    CHECK(program.t.frame == 40);
    program.live.lights[0].on = false;
    program.rounds(15);
    CHECK(program.resets == 3);
    for (std::size_t i = 0; i < 5; ++i) {
        CHECK(program.rendered[7 + i].frame == 40 + i);
        CHECK(program.rendered[7 + i].given == take.frames[i]);
    }
    CHECK(program.between(12, 17) == program.between(7, 12));
    CHECK(program.between(17, 22) == program.between(7, 12));
    CHECK_FALSE(isFinished(program.t));
    CHECK(program.t.past.back() == take.frames[4]);
    CHECK(program.t.past[9] == take.frames[2]);
}

TEST_CASE("a take that does not loop pauses at its end, and is played again from there") {
    Program program;
    program.t.paused = true;
    play(program.t, walkOf(4), false);
    CHECK_FALSE(program.t.paused);
    program.rounds(4);
    CHECK(isFinished(program.t));
    CHECK(program.t.paused);
    CHECK_FALSE(program.round(100.0));
    stepOnce(program.t);
    CHECK_FALSE(program.round(100.0));
    program.t.paused = false; // there still is no frame to render
    CHECK_FALSE(program.round(100.0));
    CHECK_THROWS_AS(nextFrame(program.t, {}), std::logic_error);

    togglePause(program.t);
    CHECK_FALSE(isFinished(program.t));
    program.rounds(4);
    CHECK(program.between(4, 8) == program.between(0, 4));
    CHECK(program.resets == 2);

    program.stop();
    CHECK_FALSE(program.t.paused);
    CHECK(program.live.camera.position.x == 13.0f);
    CHECK_FALSE(program.live.lights[1].on);
    program.rounds(1);
    CHECK(program.rendered.back().frame == 4);
    CHECK(program.rendered.back().given.seconds == doctest::Approx(1.0 + 1.0 / 60.0));
}

TEST_CASE("a take that is left before its first frame leaves no trace") {
    Program program;
    program.rounds(6);
    program.t.seconds = 2.0;
    play(program.t, walkOf(4, 100), true);
    play(program.t, walkOf(3, 200), true); // instead
    CHECK(program.t.frame == 200);
    program.stop();
    CHECK(program.t.frame == 6);
    CHECK(program.t.seconds == 2.0);
    CHECK_FALSE(program.t.resetWanted);
    CHECK(program.live.lights == std::vector<LightState>(2));

    Program unseen; // nothing has been rendered: there is nothing to hand back
    play(unseen.t, walkOf(4), true);
    CHECK_FALSE(stopPlaying(unseen.t));
    CHECK_FALSE(unseen.t.playing);
}

TEST_CASE("a played take can be stepped through, and paused, across its end") {
    Program program;
    play(program.t, walkOf(3), true);
    program.rounds(1);
    for (int i = 0; i < 5; ++i) {
        stepOnce(program.t);
        CHECK(program.round(0.0));
        CHECK_FALSE(program.round(9.0));
    }
    CHECK(program.between(3, 6) == program.between(0, 3));
}

TEST_CASE("a section of a played take can be looped, at most to its end") {
    Program program;
    play(program.t, walkOf(8, 20), true);
    program.rounds(3);
    markIn(program.t);
    program.rounds(2);
    markOut(program.t);
    program.rounds(4);
    CHECK(program.between(5, 7) == program.between(3, 5));
    CHECK(program.between(7, 9) == program.between(3, 5));

    play(program.t, walkOf(8, 20), true);
    program.rounds(5);
    markIn(program.t);
    const std::size_t first = program.rendered.size();
    program.rounds(9); // 3 to the end, and two rounds of these
    CHECK(program.t.recorded->frames.size() == 3);
    CHECK(program.t.recorded->name == "take-2");
    CHECK(program.t.recorded->frames.front().frame == 25);
    CHECK(program.between(first + 3, first + 6) == program.between(first, first + 3));
    CHECK(program.between(first + 6, first + 9) == program.between(first, first + 3));
}

TEST_CASE("a record goes on across the end of play, and is lost where another take begins") {
    Program program;
    play(program.t, walkOf(8), false);
    program.rounds(2);
    markIn(program.t);
    program.rounds(2);
    program.stop();
    program.rounds(3);
    markOut(program.t);
    CHECK(program.t.recorded->frames.size() == 5);
    program.rounds(5);
    CHECK(program.between(7, 12) == program.between(2, 7));

    markIn(program.t);
    CHECK_FALSE(program.t.recorded);
    program.rounds(1);
    replay(program.t); // there is none
    CHECK(program.t.recording);
    play(program.t, walkOf(2), true);
    CHECK_FALSE(program.t.recording);
    program.rounds(2);
    CHECK(program.t.frame == 0);
}

TEST_CASE("a record that is forgotten ends by itself") {
    Transport t;
    markIn(t);
    for (std::size_t i = 0; i < kMostRecorded; ++i) {
        CHECK(t.recording);
        nextFrame(t, {});
        frameRendered(t, 0.0);
    }
    CHECK_FALSE(t.recording);
    REQUIRE(t.playing);
    CHECK(t.playing->take.frames.size() == kMostRecorded);
    CHECK(t.frame == 0);
}
