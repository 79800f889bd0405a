// SPDX-License-Identifier: MIT
#include "app/workbench/view_state.h"

#include "renderer/base/error.h"
#include "renderer/pipeline/aov.h"

#include <algorithm>

#include <fmt/format.h>

namespace afterglow {
namespace {

constexpr double kNoticeSeconds = 5.0;

// What each light emits: the color of its first instance's material.
std::vector<glm::vec3> colorsOf(const Scene& scene) {
    std::vector<glm::vec3> colors;
    for (const Light& light : scene.lights) {
        glm::vec3 color{1.0f};
        if (!light.instances.empty())
            color = scene.materials[scene.instances[light.instances.front()].material].emission;
        colors.push_back(color);
    }
    return colors;
}

std::size_t cameraNamed(const ViewState& state, std::string_view name) {
    if (name.empty())
        return 0;
    const auto found = std::ranges::find(state.cameraNames, name);
    if (found != state.cameraNames.end())
        return std::size_t(found - state.cameraNames.begin());
    std::string message = "no camera named '" + std::string(name) + "' in the scene; known:";
    for (const std::string& known : state.cameraNames)
        message += " " + known;
    throw UsageError(message);
}

Camera cameraOf(const CameraBookmark& place, const Camera& like) {
    Camera camera = like;
    camera.position = place.position;
    camera.orientation = place.orientation;
    camera.lens.verticalFov = place.verticalFov;
    return camera;
}

// Where a camera path and cuts lead: the places remembered, with the scene's camera where there is
// but one; or a sway around it.
std::vector<Camera> stations(const ViewState& state) {
    const auto found = state.preferences.bookmarks.find(state.sceneName);
    if (found == state.preferences.bookmarks.end() || found->second.empty())
        return swayAround(state.home, 0.35f * state.extent);
    std::vector<Camera> places;
    if (found->second.size() == 1)
        places.push_back(state.home);
    for (const CameraBookmark& place : found->second)
        places.push_back(cameraOf(place, state.home));
    return places;
}

} // namespace

ViewState startState(const Scene& scene, const Settings& settings, std::string_view camera) {
    ViewState state;
    state.panes = startPanes(settings);
    enterScene(state, scene, camera);
    return state;
}

void enterScene(ViewState& state, const Scene& scene, std::string_view camera) {
    state.lightNames.clear();
    state.cameraNames.clear();
    for (const Light& light : scene.lights)
        state.lightNames.push_back(light.name);
    state.lightColors = colorsOf(scene);
    state.lights.assign(scene.lights.size(), LightState{});
    for (const SceneCamera& known : scene.cameras)
        state.cameraNames.push_back(known.name);
    state.extent = std::max(boundsOf(scene, poseAt(scene, 0.0)).extent(), 1e-3f);
    state.speed = defaultSpeed(state.extent);
    state.isAnimated = duration(scene) > 0.0;
    state.displays = imageDisplays(state.extent);
    if (state.frozen)
        toggleFreeze(state);
    startOver(state.time);
    state.onPath = false;
    state.marks.clear();
    state.hovered.reset();
    state.inspected.reset();
    clearProbes(state);
    chooseCamera(state, scene, cameraNamed(state, camera));
}

void chooseFilter(ViewState& state, Filter filter) {
    setFilter(state.panes, state.panes.active, filter);
}

void cycleFilter(ViewState& state, int step) {
    const auto filters = allFilters();
    const auto now = std::ranges::find(filters, state.settings().filter) - filters.begin();
    chooseFilter(state, filters[wrapped(std::size_t(now), step, filters.size())]);
}

void toggleLight(ViewState& state, std::size_t slot) {
    if (slot >= state.lights.size())
        return;
    letHappen(state, {EventKind::Toggle, slot});
    notify(state, "Light " + state.lightNames[slot] + (state.lights[slot].on ? " on" : " off"));
}

void toggleKeyLight(ViewState& state) {
    const auto key = std::ranges::find(state.lightNames, "key");
    toggleLight(state,
                key == state.lightNames.end() ? 0 : std::size_t(key - state.lightNames.begin()));
}

void changeExposure(ViewState& state, float stops) {
    const Field& field = fieldByKey("exposure");
    setField(state.panes, field,
             fieldValue(settingsOf(state.panes, state.panes.active), field) + double(stops));
}

void toggleAnimation(ViewState& state) {
    state.time.animate = !state.time.animate;
    if (!state.isAnimated)
        notify(state, "Nothing moves in this scene");
}

void goHome(ViewState& state) {
    state.camera = state.home;
    state.onPath = false;
    state.cutPending = true;
}

void chooseCamera(ViewState& state, const Scene& scene, std::size_t index) {
    state.cameraIndex = index;
    state.home = cameraAt(scene, poseAt(scene, state.time.seconds), index);
    goHome(state);
}

void cutCamera(ViewState& state) {
    const std::vector<Camera> places = stations(state);
    // The one after the place where the camera is; from anywhere else, the first.
    std::size_t next = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
        if (places[i] == state.camera)
            next = (i + 1) % places.size();
    state.camera = places[next];
    state.onPath = false;
    state.cutPending = true;
}

std::vector<CameraBookmark>& bookmarks(ViewState& state) {
    return state.preferences.bookmarks[state.sceneName];
}

void addBookmark(ViewState& state) {
    auto& places = bookmarks(state);
    if (places.size() >= kBookmarks)
        return notify(state,
                      "Nine places are remembered in this scene, which is all there is room for",
                      true);
    int number = int(places.size()) + 1;
    const auto taken = [&](const std::string& name) {
        return std::ranges::find(places, name, &CameraBookmark::name) != places.end();
    };
    while (taken("place " + std::to_string(number)))
        ++number;
    rememberPlace(state.preferences, state.sceneName,
                  {.name = "place " + std::to_string(number),
                   .position = state.camera.position,
                   .orientation = state.camera.orientation,
                   .verticalFov = state.camera.lens.verticalFov});
    notify(state,
           "Remembered as " + places.back().name + ": Ctrl Shift " + std::to_string(places.size()));
}

void goToBookmark(ViewState& state, std::size_t index) {
    const auto& places = bookmarks(state);
    if (index >= places.size())
        return;
    state.camera = cameraOf(places[index], state.home);
    state.onPath = false;
    state.cutPending = true;
}

void cycleImage(ViewState& state, int step) {
    const std::size_t count = aovs().size() + 1; // 0 is the picture
    const bool isAov = state.shown.kind == Shown::Kind::Image && !state.shown.isTruth();
    std::size_t place = isAov ? state.shown.index + 1 : 0;
    for (std::size_t tried = 0; tried < count; ++tried) {
        place = wrapped(place, step, count);
        if (place == 0)
            return show(state, Shown::Kind::Picture);
        show(state, Shown::Kind::Image, place - 1);
        if (shownAov(state, state.panes.active))
            return;
    }
}

void show(ViewState& state, Shown::Kind kind, std::size_t index) {
    state.shown = {kind, index};
}

void setProbe(ViewState& state, std::size_t index, const Probe& probe, glm::ivec2 image) {
    state.probes.at(index) = PlacedProbe{probe, image};
    state.activeProbe = index;
    state.showCurves = true;
}

void clearProbes(ViewState& state) {
    state.probes = {};
    state.activeProbe = 0;
}

void toggleFreeze(ViewState& state) {
    state.frozen = !state.frozen;
    if (state.frozen) {
        state.pausedBefore = state.time.paused;
        state.time.paused = true;
        state.time.stepsLeft = 0;
        return show(state, Shown::Kind::Image, aovs().size()); // the first of the truth
    }
    state.time.paused = state.pausedBefore;
    if (state.shown.isTruth())
        show(state, Shown::Kind::Picture);
}

void stopTake(ViewState& state) {
    if (!state.experiment.empty()) {
        state.wanted.leaveExperiment = true;
        return;
    }
    if (const auto last = stopPlaying(state.time))
        follow(state, *last);
}

void toggleRepeat(ViewState& state) {
    startRepeat(state.time, state.time.repeat.every > 0 ? 0 : state.repeatEvery);
    notify(state, state.time.repeat.every > 0
                      ? nameOf(state.repeated, state.lightNames) + " every " +
                            std::to_string(state.time.repeat.every) + " frames"
                      : "Nothing repeats");
}

void notify(ViewState& state, std::string text, bool isError) {
    state.notice = {std::move(text), isError, isError ? 2.0 * kNoticeSeconds : kNoticeSeconds};
}

SceneFrame liveFrame(ViewState& state) {
    if (repeatIsDue(state.time))
        letHappen(state, state.repeated);
    if (state.onPath) {
        state.camera = onPath(stations(state), state.pathSeconds);
        state.pathSeconds += kFixedStep;
    }
    SceneFrame frame{.seconds = state.time.seconds,
                     .camera = state.camera,
                     .lights = state.lights,
                     .marks = std::exchange(state.marks, {}),
                     .step = false};
    const bool cut = std::exchange(state.cutPending, false);
    if (!state.time.last)
        return frame;
    const SceneFrame& last = *state.time.last;
    if (cut && last.camera != state.camera)
        frame.marks.push_back("camera cut");
    const auto changes = lightChanges(0, state.lightNames, last.lights, state.lights);
    const bool moves = state.isAnimated && last.seconds != frame.seconds;
    frame.step = !changes.empty() && frame.marks.empty() && last.camera == state.camera && !moves;
    for (const LightEvent& change : changes)
        frame.marks.push_back(describe(change));
    return frame;
}

void follow(ViewState& state, const SceneFrame& frame) {
    state.camera = frame.camera;
    for (std::size_t i = 0; i < state.lights.size(); ++i)
        state.lights[i] = lightIn(frame.lights, i);
    state.onPath = false;
}

void passTime(ViewState& state, double wallSeconds) {
    state.notice.secondsLeft = std::max(state.notice.secondsLeft - wallSeconds, 0.0);
}

std::span<const SignalInfo> signalsOf(const ViewState& state) {
    return signalsOf(Signal(state.panes.frame.lighting.signal));
}

std::size_t shownSignal(const ViewState& state, std::size_t signals) {
    return std::min(state.signal, signals - 1);
}

std::optional<std::size_t> shownAov(const ViewState& state, std::size_t pane) {
    const Shown& shown = state.shown;
    const bool isMade = shown.kind == Shown::Kind::Image &&
                        isMadeBy(images()[shown.index], state.panes.all.at(pane).settings);
    return isMade ? std::optional(shown.index) : std::nullopt;
}

std::filesystem::path freePath(const std::filesystem::path& folder, std::string_view stem,
                               std::string_view ending) {
    for (int number = 1;; ++number) {
        const auto path = folder / fmt::format("{}-{:04}{}", stem, number, ending);
        if (!std::filesystem::exists(path))
            return path;
    }
}

} // namespace afterglow
