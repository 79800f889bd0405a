// SPDX-License-Identifier: MIT
#include "app/window/view.h"

#include "app/scenario/experiment.h"
#include "app/scenario/run_plan.h"
#include "app/window/viewer.h"
#include "renderer/base/error.h"
#include "renderer/base/log.h"
#include "renderer/scene/load_scene.h"

namespace afterglow {
namespace {

constexpr std::string_view kFirstScene = "hall";

/// What was remembered, and where; nothing of both where there is no place for it.
struct Memory {
    std::optional<std::filesystem::path> file;
    Preferences preferences;
};

Memory recall(bool reset) {
    Memory memory;
    const auto folder = configFolder();
    if (!folder)
        return memory;
    memory.file = *folder / "preferences.json";
    if (reset)
        resetPreferences(*memory.file);
    LoadedPreferences loaded = loadPreferences(*memory.file);
    if (!loaded.warning.empty())
        log(LogLevel::Warning, loaded.warning);
    memory.preferences = std::move(loaded.preferences);
    return memory;
}

/// The scene that is opened first, and whether an experiment is to be played in it.
struct Opening {
    std::string name;
    Scene scene;
    bool isExperiment = false;
};

// The scene that was open last may be gone: that is no reason not to start.
Opening openingFor(const ViewOptions& options, const Preferences& preferences) {
    if (!options.scene.empty() && Workbench::isExperiment(options.scene)) {
        const Experiment experiment = loadExperiment(options.scene);
        return {experiment.scene, stagedRun(experiment).scene, true};
    }
    if (!options.scene.empty())
        return {options.scene, loadScene(options.scene), false};
    if (!preferences.lastScene.empty()) {
        try {
            return {preferences.lastScene, loadScene(preferences.lastScene), false};
        } catch (const Error& error) {
            log(LogLevel::Warning, std::string("the last scene: ") + error.what());
        }
    }
    return {std::string(kFirstScene), loadScene(kFirstScene), false};
}

} // namespace

void runView(const ViewOptions& options) {
    // What was asked for is looked at before there is a window.
    Memory memory = recall(options.resetSettings);
    Opening opening = openingFor(options, memory.preferences);
    ViewState state = startState(opening.scene, options.settings, options.camera);
    state.preferences = std::move(memory.preferences);
    state.sceneName = state.preferences.lastScene = opening.name;
    state.seed = options.seed;
    state.time.animate = options.animate;
    if (opening.isExperiment)
        state.wanted.open = options.scene;
    Viewer viewer(options, std::move(opening.scene), std::move(state));
    viewer.run();
    if (memory.file && options.uiCost == 0 && options.frames == 0)
        savePreferences(*memory.file, viewer.preferences());
}

} // namespace afterglow
