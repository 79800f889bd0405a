#include "app/workbench/transport.h"

#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

/// What a program renders with a transport: each picture is told apart from every other by all that
/// goes into it, the pictures before included.
struct Program {
    struct Rendered {
        std::uint32_t frame;
        FrameMoment moment;
        std::string picture;

        bool operator==(const Rendered&) const = default;
    };

    Transport t;
    FrameMoment live{.lights = std::vector<LightState>(2)};
    std::string histories = "none", checkpoint = "none";
    int resets = 0, restores = 0, checkpoints = 0;
    std::vector<Rendered> rendered;

    /// One round of its loop, with the clock that much further; whether it rendered.
    bool round(double seconds = 0.02) {
        if (!wantsFrame(t, seconds))
            return false;
        if (std::exchange(t.resetWanted, false)) {
            histories = "none";
            ++resets;
        }
        if (std::exchange(t.restoreWanted, false)) {
            histories = checkpoint;
            ++restores;
        }
        if (std::exchange(t.checkpointWanted, false)) {
            checkpoint = histories;
            ++checkpoints;
        }
        if (repeatIsDue(t))
            toggle(0, "key");
        const FrameMoment moment = nextMoment(t, live);
        live.marks.clear();
        live.step = false;
        std::string input = histories + "|" + std::to_string(t.frame) + "|" +
                            std::to_string(moment.seconds) + "|" +
                            std::to_string(moment.camera.position.x);
        for (const LightState& light : moment.lights)
            input += light.on ? "1" : "0";
        histories = std::to_string(std::hash<std::string>{}(input));
        rendered.push_back({t.frame, moment, histories});
        frameRendered(t, seconds);
        return true;
    }

    void rounds(int count, double seconds = 0.02) {
        for (int i = 0; i < count; ++i)
            REQUIRE(round(seconds));
    }

    void toggle(std::size_t slot, const std::string& name) {
        live.lights[slot].on = !live.lights[slot].on;
        live.marks.push_back(name + (live.lights[slot].on ? " on" : " off"));
        live.step = true;
    }

    /// Leaves the take as the window does.
    void stop() {
        if (const auto last = stopPlaying(t)) {
            live.camera = last->camera;
            live.lights = last->lights;
        }
    }

    std::vector<Rendered> between(std::size_t first, std::size_t end) const {
        return {rendered.begin() + std::ptrdiff_t(first), rendered.begin() + std::ptrdiff_t(end)};
    }

    /// 5 frames, in, 4 frames, key off, 6 frames, out.
    void recordTenFrames() {
        rounds(5);
        markIn(t);
        rounds(4);
        toggle(0, "key");
        live.camera.position.x = 3.0f;
        rounds(6);
        markOut(t);
    }
};

Take takeOf(int frames, std::uint32_t first = 0) {
    Take take{.name = "walk", .firstFrame = first};
    for (int i = 0; i < frames; ++i) {
        FrameMoment moment{.seconds = 0.25 * (i + 1), .lights = std::vector<LightState>(2)};
        moment.camera.position.x = 10.0f + float(i);
        moment.lights[1].on = i < 2;
        if (i == 2) {
            moment.marks = {"fill off"};
            moment.step = true;
        }
        take.frames.push_back(moment);
    }
    return take;
}

} // namespace

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
        CHECK(rendered[i].moment.seconds == double(i) / 60.0);
        CHECK(rendered[i].moment.lights[1].on == (i < 2));
        CHECK(rendered[i].moment.camera.position.x == (i < 2 ? 0.0f : 2.0f));
        CHECK(rendered[i].moment.step == (i == 2));
    }
    CHECK(rendered[2].moment.marks == std::vector<std::string>{"fill off"});
    CHECK(program.resets + program.restores + program.checkpoints == 0);
}

TEST_CASE("the time of a fixed frame is its number over the rate, to the last bit") {
    Program program;
    for (int frame = 0; frame < 2000; ++frame)
        program.round();
    for (int frame = 0; frame < 2000; ++frame)
        CHECK(program.rendered[std::size_t(frame)].moment.seconds == frame / 60.0);

    program.t.seconds = 0.505; // not on a sixtieth
    program.rounds(2);
    CHECK(program.t.seconds == doctest::Approx(0.505 + 2.0 / 60.0).epsilon(1e-12));
}

TEST_CASE("scene time runs like the clock, but a stall does not make it jump; or it stands") {
    Transport t{.timeStep = TimeStep::WallClock};
    const auto render = [&](double wallSeconds) {
        nextMoment(t, {});
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
    nextMoment(t, {});
    frameRendered(t, 1.0);
    CHECK_FALSE(wantsFrame(t, 0.9));
    CHECK(wantsFrame(t, 1.0));
    faster(t);
    CHECK_FALSE(wantsFrame(t, 0.45));
    CHECK(wantsFrame(t, 0.5));
    stepOnce(t);
    CHECK(wantsFrame(t, 0.0));

    t = {.frameLimit = 30, .last = FrameMoment{}};
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
    CHECK(past.front() == PastFrame{150, {}, false});
    CHECK(past[550] == PastFrame{700, {"key on"}, true});
    CHECK(past.back() == PastFrame{749, {}, false});
    int marked = 0;
    for (const PastFrame& frame : past)
        marked += int(!frame.marks.empty());
    CHECK(marked == 1);
}

TEST_CASE("between the in and the out point every round has the same bits as the first time") {
    Program program;
    program.recordTenFrames();
    CHECK(program.checkpoints == 1);
    CHECK(program.t.restoreWanted);
    CHECK(program.t.frame == 5);
    CHECK(program.t.seconds == 5.0 / 60.0);
    REQUIRE(program.t.recorded);
    CHECK(program.t.recorded->name == "take-1");
    CHECK(program.t.recorded->firstFrame == 5);
    CHECK(program.t.recorded->frames.size() == 10);

    program.toggle(1, "fill"); // does not count now
    program.live.camera.position.x = -7.0f;
    program.rounds(35);
    CHECK(program.restores == 4);
    const auto recorded = program.between(5, 15);
    CHECK(recorded[4].moment.marks == std::vector<std::string>{"key off"});
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
    CHECK(program.t.recorded->firstFrame == 7);
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
    CHECK(program.rendered[first].moment == program.rendered[5].moment);
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
    const Take take = takeOf(5, 40);
    play(program.t, take, true);
    CHECK(program.t.resetWanted);
    CHECK(program.t.frame == 40);
    program.live.lights[0].on = false;
    program.rounds(15);
    CHECK(program.resets == 3);
    for (std::size_t i = 0; i < 5; ++i) {
        CHECK(program.rendered[7 + i].frame == 40 + i);
        CHECK(program.rendered[7 + i].moment == take.frames[i]);
    }
    CHECK(program.between(12, 17) == program.between(7, 12));
    CHECK(program.between(17, 22) == program.between(7, 12));
    CHECK_FALSE(isFinished(program.t));
    CHECK(program.t.past.back() == PastFrame{44, {}, false});
    CHECK(program.t.past[9] == PastFrame{42, {"fill off"}, true});
}

TEST_CASE("a take that does not loop pauses at its end, and is played again from there") {
    Program program;
    program.t.paused = true;
    play(program.t, takeOf(4), false);
    CHECK_FALSE(program.t.paused);
    program.rounds(4);
    CHECK(isFinished(program.t));
    CHECK(program.t.paused);
    CHECK_FALSE(program.round(100.0));
    stepOnce(program.t);
    CHECK_FALSE(program.round(100.0));
    program.t.paused = false; // there still is no frame to render
    CHECK_FALSE(program.round(100.0));
    CHECK_THROWS_AS(nextMoment(program.t, {}), std::logic_error);

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
    CHECK(program.rendered.back().moment.seconds == doctest::Approx(1.0 + 1.0 / 60.0));
}

TEST_CASE("a take that is left before its first frame leaves no trace") {
    Program program;
    program.rounds(6);
    program.t.seconds = 2.0;
    play(program.t, takeOf(4, 100), true);
    play(program.t, takeOf(3, 200), true); // instead
    CHECK(program.t.frame == 200);
    program.stop();
    CHECK(program.t.frame == 6);
    CHECK(program.t.seconds == 2.0);
    CHECK_FALSE(program.t.resetWanted);
    CHECK(program.live.lights == std::vector<LightState>(2));

    Program unseen; // nothing has been rendered: there is nothing to hand back
    play(unseen.t, takeOf(4), true);
    CHECK_FALSE(stopPlaying(unseen.t));
    CHECK_FALSE(unseen.t.playing);
}

TEST_CASE("a played take can be stepped through, and paused, across its end") {
    Program program;
    play(program.t, takeOf(3), true);
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
    play(program.t, takeOf(8, 20), true);
    program.rounds(3);
    markIn(program.t);
    program.rounds(2);
    markOut(program.t);
    program.rounds(4);
    CHECK(program.between(5, 7) == program.between(3, 5));
    CHECK(program.between(7, 9) == program.between(3, 5));

    play(program.t, takeOf(8, 20), true);
    program.rounds(5);
    markIn(program.t);
    const std::size_t first = program.rendered.size();
    program.rounds(9); // 3 to the end, and two rounds of these
    CHECK(program.t.recorded->frames.size() == 3);
    CHECK(program.t.recorded->name == "take-2");
    CHECK(program.t.recorded->firstFrame == 25);
    CHECK(program.between(first + 3, first + 6) == program.between(first, first + 3));
    CHECK(program.between(first + 6, first + 9) == program.between(first, first + 3));
}

TEST_CASE("a record goes on across the end of play, and is lost where another take begins") {
    Program program;
    play(program.t, takeOf(8), false);
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
    play(program.t, takeOf(2), true);
    CHECK_FALSE(program.t.recording);
    program.rounds(2);
    CHECK(program.t.frame == 0);
}

TEST_CASE("a record that is forgotten ends by itself") {
    Transport t;
    markIn(t);
    for (std::size_t i = 0; i < kMostRecorded; ++i) {
        CHECK(t.recording);
        nextMoment(t, {});
        frameRendered(t, 0.0);
    }
    CHECK_FALSE(t.recording);
    REQUIRE(t.playing);
    CHECK(t.playing->take.frames.size() == kMostRecorded);
    CHECK(t.frame == 0);
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
        if (rendered.moment.step)
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
    play(program.t, takeOf(4), true);
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
    nextMoment(t, {});
    nextMoment(t, {}); // asking twice is fine
    frameRendered(t, 0.0);
    CHECK(t.frame == 1);
}
