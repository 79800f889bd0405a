// SPDX-License-Identifier: MIT
#pragma once

#include "app/scenario/scene_frame.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

namespace afterglow {

enum class TimeStep {
    Fixed,    ///< 1/60 s of scene time a frame, however long the frame takes
    WallClock ///< scene time runs like the clock
};
inline constexpr double kFixedRate = 60.0;             ///< frames per second of scene time
inline constexpr double kFixedStep = 1.0 / kFixedRate; ///< seconds
inline constexpr double kLongestStep = 0.1; ///< seconds; a stall must not make the scene jump

/// Limits of frames per second, from fast to slow. 0: as fast as possible.
inline constexpr std::array<int, 6> kFrameLimits = {0, 30, 10, 5, 2, 1};

inline constexpr std::size_t kPast = 600;           ///< frames that are remembered for the strip
inline constexpr std::size_t kMostRecorded = 36000; ///< frames: ten minutes at 60 a second

/// Something that a person does again and again without a hand: in the frames first,
/// first + every, ...
struct Repeat {
    int every = 0; ///< frames; 0: never
    std::uint32_t first = 0;
};

/// A take that is played, in place of what the person does.
struct Playing {
    Take take{};
    std::size_t next = 0; ///< index of the next of its frames; their number: it has ended
    bool loops = false;
    bool fromCheckpoint = false; ///< a round begins with the histories kept, else with none
    // Where live play goes on if the take is left before a frame of this round has been rendered.
    std::uint32_t frameBefore = 0;
    double secondsBefore = 0.0;
};

/// Everything of the window that concerns time, as plain values. For each frame, the program asks:
///
///     if (wantsFrame(t, secondsSinceLastFrame)) {
///         if (std::exchange(t.resetWanted, false))       // forgets all histories
///         if (std::exchange(t.restoreWanted, false))     // they are those of the checkpoint
///         if (std::exchange(t.checkpointWanted, false))  // the checkpoint is a copy of them
///         const SceneFrame given = nextFrame(t, live);
///         // renders `given` as frame t.frame
///         frameRendered(t, wallSeconds);
///     }
///
/// in this order. Frame numbers rise by one except where a take begins.
struct Transport {
    bool paused = false;
    int stepsLeft = 0;   ///< frames to render although paused
    int frameLimit = 0;  ///< one of kFrameLimits
    bool animate = true; ///< whether scene time goes on
    TimeStep timeStep = TimeStep::Fixed;
    std::uint32_t frame = 0; ///< number of the next frame
    double seconds = 0.0;    ///< scene time of the next frame
    Repeat repeat{};

    std::deque<SceneFrame> past{};    ///< the last kPast frames, the newest last
    std::optional<SceneFrame> last{}; ///< what the last rendered frame was given

    std::optional<Playing> playing{}; ///< empty: the person's hand is live
    std::optional<Take> recording{};  ///< since the in point
    std::optional<Take> recorded{};   ///< from the in point to the out point
    bool hasCheckpoint = false;       ///< of the in point
    int takesRecorded = 0;            ///< they are named "take-1", "take-2", ...

    // Asked for, and done and cleared by the program.
    bool resetWanted = false, restoreWanted = false, checkpointWanted = false;

    std::optional<SceneFrame> given{}; ///< by nextFrame(), until it is rendered
};

/// Returns whether a frame is to be rendered now. The first one always is, so that there is
/// something to see; one that is stepped to at once, whatever the limit.
bool wantsFrame(const Transport& t, double secondsSinceLastFrame);
/// Returns the seconds until the next frame is due: 0 at least, infinity where none is wanted.
double secondsUntilFrame(const Transport& t, double secondsSinceLastFrame);

/// Returns the next frame: `live`, with the transport's number and time, or what the played
/// take says.
/// Where a take has ended there is none: a std::logic_error.
SceneFrame nextFrame(Transport& t, const SceneFrame& live);

/// Records that a frame was rendered. A std::logic_error if nextFrame() was not asked before it.
void frameRendered(Transport& t, double wallSeconds);

void togglePause(Transport& t); ///< at the end of a take: plays it again
void stepOnce(Transport& t);    ///< one frame, and paused after it; none at the end of a take
void slower(Transport& t);      ///< the next of kFrameLimits
void faster(Transport& t);

/// From the next frame on, what is rendered is recorded, whether live or of a take. Asks for a
/// checkpoint; an earlier record is lost with its own.
void markIn(Transport& t);
/// Ends the record and loops it from the checkpoint, each round bit for bit like the one before.
/// Nothing happens if nothing has been recorded. A take that ends, or has kMostRecorded frames,
/// does the same.
void markOut(Transport& t);
/// Loops the record again, from its checkpoint or, if that is lost, without histories. Nothing
/// happens without one, or while the next is recorded.
void replay(Transport& t);

/// Plays a take from nothing: without histories, from its first frame number on. At its end it
/// begins again, or the transport pauses: see isFinished(). What is being recorded is lost. A take
/// without frames is a std::logic_error.
void play(Transport& t, Take take, bool loop);

/// Leaves the take; live play goes on where it is, with the next frame number and the histories as
/// they are. Returns what the last rendered frame was given: its camera and lights are now the
/// person's. Empty if no take was played or no frame has been rendered.
[[nodiscard]] std::optional<SceneFrame> stopPlaying(Transport& t);

/// Forgets the checkpoint, as after a change of resolution: rounds begin without histories.
void checkpointLost(Transport& t);

/// For another scene: frame 0, no take, nothing past. How time runs stays.
void startOver(Transport& t);

bool isFinished(const Transport& t); ///< at the end of a take that does not loop

/// Begins to repeat with the next frame; every = 0 ends it.
void startRepeat(Transport& t, int every);
/// Returns whether what repeats happens in the next frame; never while a take is played. To be
/// asked once a frame, before it is rendered.
bool repeatIsDue(const Transport& t);

} // namespace afterglow
