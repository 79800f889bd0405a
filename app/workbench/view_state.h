// SPDX-License-Identifier: MIT
#pragma once

#include "app/measure/probe_log.h"
#include "app/scenario/timeline.h"
#include "app/workbench/camera_flight.h"
#include "app/workbench/fields.h"
#include "app/workbench/frame_images.h"
#include "app/workbench/keymap.h"
#include "app/workbench/panes.h"
#include "app/workbench/preferences.h"
#include "app/workbench/scene_event.h"
#include "app/workbench/transport.h"
#include "renderer/scene/scene.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace afterglow {

/// What the person at the window is told for a moment.
struct Notice {
    std::string text;
    bool isError = false;
    double secondsLeft = 0.0;
};

/// What the panes show.
struct Shown {
    enum class Kind {
        Picture, ///< the denoised picture
        Image,   ///< `index` into images() and ViewState::displays
        Pass,    ///< `index` of what the passes of the frame made, one after the other
    };
    Kind kind = Kind::Picture;
    std::size_t index = 0;

    /// An image of a frozen frame, which is there once its reference has converged.
    bool isTruth() const { return kind == Kind::Image && afterglow::isTruth(index); }
    bool operator==(const Shown&) const = default;
};

/// A probe, as it was set on a picture of that size.
struct PlacedProbe {
    Probe probe;
    glm::ivec2 image{1};
    bool operator==(const PlacedProbe&) const = default;
};

/// Asked for by keys and widgets; done and cleared by the program.
struct Requests {
    bool fitRange = false;
    bool picture = false, window = false, imageFiles = false; ///< to be saved
    bool record = false;                                      ///< frames: begin, or end
    bool copyCurves = false, saveCurves = false;              ///< of the probes, as CSV
    bool copyPreset = false, pastePreset = false;
    std::string savePreset, removePreset; ///< a name; empty: none
    bool saveTake = false;                ///< as an experiment
    bool reloadShaders = false;
    bool probeAtMouse = false; ///< the active probe, on ViewState::hovered
    int passStep = 0;          ///< so many passes of a frame on, or back; one a round
    std::string open;          ///< a scene or an experiment, by name or path; empty: none
    bool leaveExperiment = false;
    std::optional<std::size_t> tourStop;
};

/// All that a person can change, as plain values: no window, no OpenGL. Every widget and every key
/// does what one of the functions below does.
struct ViewState {
    Panes panes;
    Transport time;

    std::string sceneName;               ///< as it was asked for: a name or a path
    std::string experiment;              ///< that is played; empty: none
    std::vector<std::string> lightNames; ///< by slot
    std::vector<glm::vec3> lightColors;  ///< by slot: what they emit, linear
    std::vector<LightState> lights;      ///< by slot
    bool isAnimated = false;             ///< whether anything in the scene can move
    float extent = 1.0f;                 ///< of the scene, meters

    Camera camera;
    Camera home; ///< where goHome() leads
    std::vector<std::string> cameraNames;
    std::size_t cameraIndex = 0; ///< whose pose `home` was
    float speed = 1.0f;          ///< meters per second
    bool onPath = false;
    double pathSeconds = 0.0;

    SceneEvent repeated;            ///< the last thing that was let happen
    int repeatEvery = 60;           ///< frames, when it repeats
    std::vector<std::string> marks; ///< of the next frame, beside what its lights tell
    bool cutPending = false;        ///< the camera has jumped: marks it

    std::uint32_t seed = 0;
    Resolution resolution;
    Shown shown;
    std::size_t signal = 0; ///< whose images, lambda and history are looked at; see shownSignal()
    std::vector<ImageDisplay> displays; ///< by images()

    std::array<std::optional<PlacedProbe>, kProbes> probes;
    std::size_t activeProbe = 0;
    ProbeQuantity curve = ProbeQuantity::Lit;

    std::optional<PanePixel> hovered;   ///< under the mouse
    std::optional<PanePixel> inspected; ///< pinned
    bool frozen = false; ///< the moment is held and its reference converges; nothing is rendered
    bool pausedBefore = false; ///< whether time stood still before that
    int oracleSamples = 1024;  ///< a pixel, of the reference
    int recordFrames = 0;      ///< after which a recording ends; 0: when it is told to
    std::optional<std::size_t> tourStop;

    Preferences preferences;
    bool showHelp = false, showInspector = false, showCurves = false, showPasses = false,
         showStrip = true, showPresets = false;
    Notice notice;
    Requests wanted;
    bool keyboardInPanel = false; ///< keys move in the panel and press its buttons
    bool quit = false;

    /// Of the active pane.
    FilterSettings& settings() { return panes.all[panes.active].settings; }
    const FilterSettings& settings() const { return panes.all[panes.active].settings; }
};

/// The state in which a scene is first seen. UsageError names an unknown camera and the known ones.
ViewState startState(const Scene& scene, const Settings& settings, std::string_view camera = {});
/// For another scene: lights, cameras, time and probes start over; panes, panels and preferences
/// stay.
void enterScene(ViewState& state, const Scene& scene, std::string_view camera = {});

void chooseFilter(ViewState& state, Filter filter); ///< of the active pane
void cycleFilter(ViewState& state, int step = 1);
void toggleLight(ViewState& state, std::size_t slot); ///< nothing without such a slot
void toggleKeyLight(ViewState& state);                ///< the light named "key", else the first
void changeExposure(ViewState& state, float stops);   ///< stays in the field's range
void toggleAnimation(ViewState& state);
void goHome(ViewState& state);
void chooseCamera(ViewState& state, const Scene& scene, std::size_t index);
/// To the next of the bookmarks (of home and the one, if there is one), or of views around home.
void cutCamera(ViewState& state);
std::vector<CameraBookmark>& bookmarks(ViewState& state); ///< of this scene
void addBookmark(ViewState& state);                       ///< at most kBookmarks
void goToBookmark(ViewState& state, std::size_t index);
/// The picture, then those images that the active filter makes.
void cycleImage(ViewState& state, int step);
void show(ViewState& state, Shown::Kind kind, std::size_t index = 0);
void setProbe(ViewState& state, std::size_t index, const Probe& probe, glm::ivec2 image);
void clearProbes(ViewState& state);
void toggleFreeze(ViewState& state); ///< also pauses; leaves images of the truth when it ends
/// Ends a take and keeps its camera and lights. Those of an experiment are dropped for those that
/// were set before it.
void stopTake(ViewState& state);
void toggleRepeat(ViewState& state);
void notify(ViewState& state, std::string text, bool isError = false);

/// Before a frame: what the person's hands make of it, with marks of what changed since the last.
/// What repeats happens here.
SceneFrame liveFrame(ViewState& state);
/// While a take plays, the lights and the camera that are seen are its own.
void follow(ViewState& state, const SceneFrame& frame);
/// In every round of the loop, rendered or not.
void passTime(ViewState& state, double wallSeconds);

/// The signals of the next frame.
std::span<const SignalInfo> signalsOf(const ViewState& state);
/// The signal that is looked at in a frame with so many: the last frame may have other ones than
/// the next.
std::size_t shownSignal(const ViewState& state, std::size_t signals);

/// The AOV that a pane shows, unless its filter does not make it.
std::optional<std::size_t> shownAov(const ViewState& state, std::size_t pane);

/// "afterglow-0001.png" and so on, with the first number for which no file is there.
std::filesystem::path freePath(const std::filesystem::path& folder, std::string_view stem,
                               std::string_view ending);

} // namespace afterglow
