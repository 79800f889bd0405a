// SPDX-License-Identifier: MIT
#pragma once

#include "app/scenario/scene_frame.h"

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace afterglow {

// Events of a timeline. Frames count from 0; an event shows in its own frame for the first time.
// Events at frame 0 set the scene up. What lasts from `frame` to `until` is on its way in the
// frames [frame, until): at frame - 1 it has not begun, in frame until - 1 it has arrived. until =
// frame + 1 is a jump.

/// Sets a light differently from `frame` on. An empty field stays as it was.
struct LightEvent {
    int frame = 0;     ///< >= 0
    std::string light; ///< a light's name; "*": all lights
    std::optional<bool> on = {};
    std::optional<float> power = {};    ///< see LightState
    std::optional<glm::vec3> tint = {}; ///< see LightState

    bool operator==(const LightEvent&) const = default;
};

/// A node of the scene glides and turns, at constant speed.
struct NodeMotion {
    int frame = 0, until = 1;
    std::string node;
    glm::vec3 by{0.0f}; ///< meters, in its parent's space, from where it was
    float turn = 0.0f;  ///< degrees about its own vertical axis, in (-180, 180)

    bool operator==(const NodeMotion&) const = default;
};

/// The camera travels and turns to another view.
struct CameraMove {
    int frame = 0, until = 1;
    glm::vec3 eye{0.0f}, target{0.0f}; ///< meters, world; upright

    bool operator==(const CameraMove&) const = default;
};

/// Returns the light with what the event sets.
LightState withEvent(const LightState& light, const LightEvent& event);

/// Returns the event that makes `after` of `before`, or nothing where they are equal.
std::optional<LightEvent> changeOf(int frame, const std::string& light, const LightState& before,
                                   const LightState& after);

/// Returns what changes light by light, by slot; see lightIn() for lists that miss some.
std::vector<LightEvent> lightChanges(int frame, std::span<const std::string> names,
                                     std::span<const LightState> before,
                                     std::span<const LightState> after);

using TimelineEvent = std::variant<LightEvent, NodeMotion, CameraMove>;

int frameOf(const TimelineEvent& event);
/// "key off", "key to 50 %", "key untinted", "mover moves", "camera cut".
std::string describe(const TimelineEvent& event);

/// The events of the frames 0 .. frames - 1, in the order of their frames. Events of one frame
/// apply in the order in which they are listed.
class Timeline {
public:
    Timeline() = default;
    /// Frames must be in order, and in [0, frames); what moves must have arrived before it moves
    /// again, and until > frame. Anything else is a std::logic_error.
    Timeline(int frames, std::vector<TimelineEvent> events);

    int frames() const { return frames_; }
    const std::vector<TimelineEvent>& events() const { return events_; }
    bool moves() const; ///< whether anything but light changes

    /// Returns how each light of the scene is set, by slot.
    std::vector<LightState> lightsAt(const Scene& scene, int frame) const;

    /// Returns what a frame is rendered from in the scene that this timeline has staged.
    SceneFrame frameAt(const Scene& staged, double rate, int frame) const;

    /// Returns the scene with this timeline's motions as its tracks, at `rate` frames per second;
    /// its own tracks play only if `animated`. `owner` begins the message of the InputError that
    /// names a light or a node that the scene does not have.
    Scene staged(Scene scene, double rate, bool animated, std::string_view owner) const;

private:
    int frames_ = 0;
    std::vector<TimelineEvent> events_;
};

/// Returns the timeline in which these events, in any order, say only what they change. Events from
/// the frame `frames` on are left out. UsageError for a light that the scene does not have names
/// the nearest that it has.
Timeline lightTimeline(const Scene& scene, std::vector<LightEvent> events, int frames);

/// The frames [first, end) in which nothing changes: they share one converged picture.
struct Interval {
    int first = 0, end = 0;
    SceneFrame start{};    ///< its first frame
    SceneChange changed{}; ///< since the frame before

    int frames() const { return end - first; }
    bool isStep() const { return changed.isStep(); }
};

/// Returns the intervals of a timeline in a scene that it has staged: in order, without a gap, each
/// as long as it can be. An event that sets what is already so ends none.
std::vector<Interval> intervalsOf(const Timeline& timeline, const Scene& staged, double rate);

/// Returns the index of the interval that holds a frame.
std::size_t intervalAt(const std::vector<Interval>& intervals, int frame);

} // namespace afterglow
