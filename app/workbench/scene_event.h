#pragma once

#include "renderer/pipeline/light_state.h"
#include "renderer/scene/camera.h"

#include <span>
#include <string>
#include <vector>

namespace afterglow {

struct ViewState;

/// What a person lets happen in the scene at the press of a key.
struct SceneEvent {
    enum class Kind {
        ToggleLight, ///< on or off
        DimLight,    ///< to half its power and back
        ColorLight,  ///< to another color of equal luminance and back
        Animation,   ///< starts or stops what moves in the scene
        CameraCut,   ///< to the next camera or bookmark
        CameraPath,  ///< starts or stops the camera's way
    };
    Kind kind = Kind::ToggleLight;
    std::size_t light = 0; ///< slot

    bool operator==(const SceneEvent&) const = default;
};
inline constexpr int kSceneEventKinds = 6;
bool isLightEvent(SceneEvent::Kind kind); ///< it is about one light

/// "toggle key", "camera cut": what it will do.
std::string nameOf(const SceneEvent& event, std::span<const std::string> lightNames);

/// Does it, and remembers it as what repeats. Nothing happens without such a light.
void cause(ViewState& state, const SceneEvent& event);

/// The tint that turns light of this color (linear rgb) to another hue and leaves its luminance as
/// it is: what a gradient of luminance cannot see. White becomes blue; the key light of the Cornell
/// box does what it does in the experiment light-color. Light of one primary keeps its hue.
glm::vec3 equalLuminanceTint(glm::vec3 color);

/// What has changed from one setting of the lights to another: "key off", "fill to 50 %", "key
/// tinted".
std::vector<std::string> describeChange(std::span<const std::string> names,
                                        std::span<const LightState> before,
                                        std::span<const LightState> after);

/// A camera on a closed way through the keys, at least two, three seconds from one to the next;
/// smooth in place and direction.
Camera onPath(std::span<const Camera> keys, double seconds);
inline constexpr double kSecondsPerKey = 3.0;

/// Four keys around a camera that looks at what is that far away: a sway.
std::vector<Camera> swayAround(const Camera& home, float distance);

} // namespace afterglow
