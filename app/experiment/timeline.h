#pragma once

#include "renderer/pipeline/light_state.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace afterglow {

/// From `frame` on, a light is set differently. What is empty stays as it was.
struct LightEvent {
    int frame = 0;     ///< >= 0; events at frame 0 set the scene up
    std::string light; ///< a light's name; "*": all lights
    std::optional<bool> on = {};
    std::optional<float> power = {};    ///< see LightState
    std::optional<glm::vec3> tint = {}; ///< see LightState

    bool operator==(const LightEvent&) const = default;
};

/// How every light is set: those that events have named, and all others alike.
class LightSettings {
public:
    /// What the scene's light of this name is set to.
    const LightState& of(std::string_view light) const;

    void apply(const LightEvent& event);

    /// Equal if every light, named or not, is set alike.
    bool operator==(const LightSettings& other) const;

private:
    LightState others_;
    std::map<std::string, LightState, std::less<>> named_;
};

/// The frames [first, end) in which nothing changes.
struct Segment {
    int first = 0, end = 0;
    LightSettings lights;

    int frames() const { return end - first; }
};

/// What happens in the frames 0 .. frames - 1: events in the order of their frames. Those of one
/// frame apply in the order in which they are listed.
class Timeline {
public:
    Timeline() = default;
    /// Frames must be in order, and in [0, frames); anything else is a std::logic_error.
    Timeline(int frames, std::vector<LightEvent> events);

    int frames() const { return frames_; }
    const std::vector<LightEvent>& events() const { return events_; }

    /// The names of the lights that events name, each once, in alphabetical order, without "*".
    std::vector<std::string> lightNames() const;

    LightSettings lightsAt(int frame) const;

    /// The longest ranges of frames in which no light changes, in order and without a gap. An event
    /// that sets what is already so does not end one.
    std::vector<Segment> segments() const;

private:
    int frames_ = 0;
    std::vector<LightEvent> events_;
};

} // namespace afterglow
