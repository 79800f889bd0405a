#pragma once

#include "app/workbench/fly_camera.h"
#include "app/workbench/frame_images.h"
#include "app/workbench/keymap.h"
#include "app/workbench/layout.h"
#include "renderer/pipeline/light_state.h"
#include "renderer/pipeline/settings.h"
#include "renderer/scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace afterglow {

enum class TimeStep {
    Fixed,    ///< 1/60 s of scene time a frame, however long the frame takes
    WallClock ///< scene time runs like the clock
};
constexpr double kFixedStep = 1.0 / 60.0; ///< seconds

/// What the person at the window is told for a moment.
struct Notice {
    std::string text;
    bool isError = false;
    double secondsLeft = 0.0;
};

/// All that a person can change, as plain values: no window, no OpenGL. Every widget and every key
/// does what one of the functions below does.
struct ViewState {
    Settings settings;

    std::vector<std::string> lightNames; ///< by slot
    std::vector<LightState> lights;      ///< by slot

    Camera camera;
    Camera home; ///< where goHome() leads
    std::vector<std::string> cameraNames;
    std::size_t cameraIndex = 0; ///< whose pose `home` was
    float extent = 1.0f;         ///< of the scene, metres
    float speed = 1.0f;          ///< metres per second

    bool paused = false;
    int stepsLeft = 0; ///< frames to render although paused
    bool animate = true;
    bool isAnimated = false; ///< whether anything in the scene can move
    TimeStep timeStep = TimeStep::Fixed;
    double seconds = 0.0;    ///< scene time of the next frame
    std::uint32_t frame = 0; ///< number of the next frame; rises by one with each that is rendered
    std::uint32_t seed = 0;

    Resolution resolution;
    bool smoothScaling = true;
    std::optional<std::size_t> image; ///< index into `displays`; empty: the picture
    std::vector<ImageDisplay> displays;

    bool showPanel = true, showHelp = false, showTimings = true;
    Notice notice;

    // Asked for, and done and cleared by the frame loop.
    bool resetWanted = false, fitRangeWanted = false;
    bool pictureWanted = false, windowPictureWanted = false;
    bool quit = false;
};

/// The state in which a scene is first seen. UsageError names an unknown camera and the known ones.
ViewState startState(const Scene& scene, const Settings& settings, std::string_view camera = {});

void chooseFilter(ViewState& state, Filter filter);
void cycleFilter(ViewState& state, int step = 1);
void toggleLight(ViewState& state, std::size_t slot); ///< nothing without such a slot
void toggleKeyLight(ViewState& state);                ///< the light named "key", else the first
void changeExposure(ViewState& state, float stops);   ///< stays in the field's range
void togglePause(ViewState& state);
void stepOnce(ViewState& state); ///< one frame, and paused after it
void toggleAnimation(ViewState& state);
void goHome(ViewState& state);
void chooseCamera(ViewState& state, const Scene& scene, std::size_t index);
void cycleImage(ViewState& state,
                int step); ///< the picture, then those images that the filter makes
void notify(ViewState& state, std::string text, bool isError = false);

/// Does what a key means.
void perform(ViewState& state, const Command& command);

/// Whether the loop is to render a frame now. The first one always, so that there is something to
/// see.
bool wantsFrame(const ViewState& state);
/// After each rendered frame: counts it and lets scene time go on.
void frameRendered(ViewState& state, double wallSeconds);
/// In every round of the loop, rendered or not.
void passTime(ViewState& state, double wallSeconds);

/// The AOV that is shown, unless the filter does not make it.
std::optional<std::size_t> shownImage(const ViewState& state);

// One tunable of the table fields(), as a number: the index of an enumeration, or the value.
double fieldValue(const Settings& settings, const Field& field);
void setFieldValue(Settings& settings, const Field& field, double value); ///< clamped to its range
bool isDefault(const Settings& settings, const Field& field);
void resetField(Settings& settings, const Field& field);

/// "afterglow-0001.png", with the first number for which no file is there.
std::filesystem::path freePicturePath(const std::filesystem::path& folder);

} // namespace afterglow
