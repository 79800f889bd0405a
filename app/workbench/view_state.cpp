#include "app/workbench/view_state.h"

#include "renderer/base/error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace afterglow {
namespace {

constexpr double kNoticeSeconds = 5.0;
constexpr double kLongestStep = 0.1; // seconds; a stall must not make the scene jump

int wrapped(int index, int count) {
    return ((index % count) + count) % count;
}

const Field& fieldByKey(std::string_view key) {
    const auto field = std::ranges::find(fields(), key, &Field::key);
    if (field == fields().end())
        throw std::logic_error("no field with the key " + std::string(key));
    return *field;
}

std::string onOff(bool on) {
    return on ? "on" : "off";
}

} // namespace

ViewState startState(const Scene& scene, const Settings& settings, std::string_view camera) {
    ViewState state;
    state.settings = settings;
    for (const Light& light : scene.lights)
        state.lightNames.push_back(light.name);
    state.lights.resize(scene.lights.size());
    for (const SceneCamera& known : scene.cameras)
        state.cameraNames.push_back(known.name);
    state.extent = std::max(boundsOf(scene, poseAt(scene, 0.0)).extent(), 1e-3f);
    state.speed = defaultSpeed(state.extent);
    state.isAnimated = duration(scene) > 0.0;
    state.displays = imageDisplays(state.extent);

    std::size_t index = 0;
    if (!camera.empty()) {
        const auto found = std::ranges::find(state.cameraNames, camera);
        if (found == state.cameraNames.end()) {
            std::string message =
                "no camera named '" + std::string(camera) + "' in the scene; known:";
            for (const std::string& name : state.cameraNames)
                message += " " + name;
            throw UsageError(message);
        }
        index = std::size_t(found - state.cameraNames.begin());
    }
    chooseCamera(state, scene, index);
    return state;
}

void chooseFilter(ViewState& state, Filter filter) {
    state.settings.filter = filter;
}

void cycleFilter(ViewState& state, int step) {
    const auto filters = allFilters();
    const auto now = std::ranges::find(filters, state.settings.filter) - filters.begin();
    state.settings.filter = filters[std::size_t(wrapped(int(now) + step, int(filters.size())))];
}

void toggleLight(ViewState& state, std::size_t slot) {
    if (slot >= state.lights.size())
        return;
    LightState& light = state.lights[slot];
    light.on = !light.on;
    notify(state, "Light " + state.lightNames[slot] + " " + onOff(light.on));
}

void toggleKeyLight(ViewState& state) {
    const auto key = std::ranges::find(state.lightNames, "key");
    toggleLight(state,
                key == state.lightNames.end() ? 0 : std::size_t(key - state.lightNames.begin()));
}

void changeExposure(ViewState& state, float stops) {
    const Field& field = fieldByKey("exposure");
    setFieldValue(state.settings, field, fieldValue(state.settings, field) + stops);
}

void togglePause(ViewState& state) {
    state.paused = !state.paused;
    state.stepsLeft = 0;
}

void stepOnce(ViewState& state) {
    state.paused = true;
    ++state.stepsLeft;
}

void toggleAnimation(ViewState& state) {
    state.animate = !state.animate;
    if (!state.isAnimated)
        notify(state, "Nothing moves in this scene");
}

void goHome(ViewState& state) {
    state.camera = state.home;
}

void chooseCamera(ViewState& state, const Scene& scene, std::size_t index) {
    state.cameraIndex = index;
    state.home = cameraAt(scene, poseAt(scene, state.seconds), index);
    goHome(state);
}

void cycleImage(ViewState& state, int step) {
    const int count = int(state.displays.size()) + 1; // 0 is the picture
    int place = state.image ? int(*state.image) + 1 : 0;
    for (int tried = 0; tried < count; ++tried) {
        place = wrapped(place + step, count);
        state.image = place == 0 ? std::nullopt : std::optional(std::size_t(place - 1));
        if (place == 0 || shownImage(state))
            return;
    }
}

void notify(ViewState& state, std::string text, bool isError) {
    state.notice = {std::move(text), isError, isError ? 2.0 * kNoticeSeconds : kNoticeSeconds};
}

void perform(ViewState& state, const Command& command) {
    switch (command.action) {
    case Action::NextFilter: return cycleFilter(state, 1);
    case Action::PreviousFilter: return cycleFilter(state, -1);
    case Action::ToggleLight: return toggleLight(state, std::size_t(command.index));
    case Action::ToggleKeyLight: return toggleKeyLight(state);
    case Action::TogglePause: return togglePause(state);
    case Action::StepOnce: return stepOnce(state);
    case Action::ToggleAnimation: return toggleAnimation(state);
    case Action::ResetHistory: state.resetWanted = true; return;
    case Action::GoHome: return goHome(state);
    case Action::NextImage: return cycleImage(state, 1);
    case Action::PreviousImage: return cycleImage(state, -1);
    case Action::ShowPicture: state.image.reset(); return;
    case Action::Brighter: return changeExposure(state, 0.5f);
    case Action::Darker: return changeExposure(state, -0.5f);
    case Action::FinerPixels: state.resolution = nextResolution(state.resolution, 1); return;
    case Action::CoarserPixels: state.resolution = nextResolution(state.resolution, -1); return;
    case Action::SavePicture: state.pictureWanted = true; return;
    case Action::SaveWindow: state.windowPictureWanted = true; return;
    case Action::TogglePanel: state.showPanel = !state.showPanel; return;
    case Action::ToggleHelp: state.showHelp = !state.showHelp; return;
    case Action::Dismiss: state.showHelp = false; return;
    case Action::Quit: state.quit = true; return;
    }
}

bool wantsFrame(const ViewState& state) {
    return !state.paused || state.stepsLeft > 0 || state.frame == 0;
}

void frameRendered(ViewState& state, double wallSeconds) {
    ++state.frame;
    state.stepsLeft = std::max(state.stepsLeft - 1, 0);
    if (state.animate)
        state.seconds += state.timeStep == TimeStep::Fixed
                             ? kFixedStep
                             : std::clamp(wallSeconds, 0.0, kLongestStep);
}

void passTime(ViewState& state, double wallSeconds) {
    state.notice.secondsLeft = std::max(state.notice.secondsLeft - wallSeconds, 0.0);
}

std::optional<std::size_t> shownImage(const ViewState& state) {
    if (!state.image)
        return {};
    const AovInfo& aov = aovs()[*state.image];
    return isMadeBy(aov, state.settings.filter, state.settings.denoiser) ? state.image
                                                                         : std::nullopt;
}

double fieldValue(const Settings& settings, const Field& field) {
    Settings copy = settings; // the table gives references to what may be changed
    return std::visit([](auto* value) { return double(*value); }, field.ref(copy));
}

void setFieldValue(Settings& settings, const Field& field, double value) {
    const double allowed = std::clamp(value, field.min, field.max);
    std::visit(
        [allowed](auto* member) {
            using Member = std::remove_pointer_t<decltype(member)>;
            *member = std::is_integral_v<Member> ? Member(std::lround(allowed)) : Member(allowed);
        },
        field.ref(settings));
}

bool isDefault(const Settings& settings, const Field& field) {
    return fieldValue(settings, field) == fieldValue(Settings{}, field);
}

void resetField(Settings& settings, const Field& field) {
    setFieldValue(settings, field, fieldValue(Settings{}, field));
}

std::filesystem::path freePicturePath(const std::filesystem::path& folder) {
    for (int number = 1;; ++number) {
        char name[32];
        std::snprintf(name, sizeof name, "afterglow-%04d.png", number);
        if (!std::filesystem::exists(folder / name))
            return folder / name;
    }
}

} // namespace afterglow
