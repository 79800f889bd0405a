// SPDX-License-Identifier: MIT
// What Workbench does with files and with the clipboard.

#include "app/base/output.h"
#include "app/measure/probe_csv.h"
#include "app/scenario/experiment.h"
#include "app/scenario/presets.h"
#include "app/scenario/run_plan.h"
#include "app/scenario/take_experiment.h"
#include "app/workbench/tour.h"
#include "app/workbench/workbench.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/base/log.h"
#include "renderer/image/image_io.h"
#include "renderer/pipeline/aov.h"
#include "renderer/scene/load_scene.h"

#include <algorithm>

namespace afterglow {
namespace {

constexpr int kRecordedRate = 60; // frames per second of a film

bool isFile(const std::string& nameOrPath) {
    return nameOrPath.find('/') != std::string::npos ||
           std::filesystem::path(nameOrPath).has_extension();
}

PaneLayout layoutFor(std::size_t variants) {
    if (variants <= 1)
        return PaneLayout::Single;
    return variants == 2 ? PaneLayout::TwoUp : PaneLayout::FourUp;
}

} // namespace

void Workbench::attempt(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        notify(state, error.what(), true);
        afterglow::log(LogLevel::Error, error.what());
    }
}

void Workbench::serveRequests() {
    Requests& wanted = state.wanted;
    const auto asked = [](bool& flag) { return std::exchange(flag, false); };
    if (const std::string name = std::exchange(wanted.open, {}); !name.empty())
        open(name);
    if (asked(wanted.leaveExperiment) && suspended_)
        leaveExperiment();
    if (wanted.passStep != 0) {
        const int step = wanted.passStep > 0 ? 1 : -1;
        wanted.passStep -= step;
        stepPass(step);
    }
    if (asked(wanted.fitRange))
        fitRange();
    if (asked(wanted.picture))
        save(composedView());
    if (asked(wanted.imageFiles))
        attempt([&] { saveImageFiles(); });
    if (asked(wanted.record))
        attempt([&] { recordFrames(); });
    if (wanted.copyCurves || wanted.saveCurves)
        collect(); // curves are whole
    if (asked(wanted.copyCurves)) {
        copied_ = curvesText();
        notify(state, "The curves of " + std::to_string(log_.frames().size()) +
                          " frames are in the clipboard, as CSV");
    }
    if (asked(wanted.saveCurves))
        attempt([&] { saveCurves(); });
    if (asked(wanted.saveTake))
        attempt([&] { saveTake(); });
    if (asked(wanted.copyPreset)) {
        copied_ = presetText(presetOf("copied", settingsOf(state.panes, state.panes.active)));
        notify(state, "The preset is in the clipboard");
    }
    if (const std::string name = std::exchange(wanted.savePreset, {}); !name.empty())
        attempt([&] { savePreset(name); });
    if (const std::string name = std::exchange(wanted.removePreset, {}); !name.empty())
        attempt([&] {
            presets_.remove(name);
            notify(state, "Removed the preset " + name);
        });
}

void Workbench::fitRange() {
    const std::size_t pane = state.panes.active, index = state.shown.index;
    if (state.shown.kind != Shown::Kind::Image || !renderer_.ran(pane))
        return;
    const std::size_t signal = shownSignal(state, renderer_.signals().size());
    ImageDisplay& display = state.displays[index];
    if (!isTruth(index)) {
        if (isMadeBy(images()[index], renderer_.ran(pane)->settings))
            display = fittedTo(readAov(renderer_, images()[index], pane, signal), display);
    } else if (const GpuTexture* const image = oracle_.image(index - aovs().size(), pane, signal)) {
        display = fittedTo(image->read<glm::vec4>(), display);
    } else {
        notify(state, "There is nothing yet that a range could be fitted to", true);
    }
}

Image<glm::u8vec4> Workbench::composedView() {
    std::array<Image<glm::u8vec4>, kFilterStates> images;
    for (const std::size_t pane : shownPanes(state.panes))
        if (const GpuTexture* const picture = pictures_.of(sources(), pane))
            images[pane] = picture->read<glm::u8vec4>();
    return composed(state.panes, images);
}

void Workbench::save(const Image<glm::u8vec4>& picture) {
    attempt([&] {
        if (picture.size().x == 0)
            return notify(state, "There is no picture before the next frame", true);
        const auto path = freePath(folders_.output, "afterglow", ".png");
        writePng(path, picture);
        notify(state, "Saved " + path.string());
        afterglow::log(LogLevel::Info, "saved " + path.string());
    });
}

// Every image that the active filter makes, as 32-bit float, and the picture.
void Workbench::saveImageFiles() {
    const std::size_t pane = state.panes.active;
    if (!now_ || !renderer_.ran(pane))
        return;
    const OutputFolder folder(freePath(folders_.output, "afterglow-images", ""));
    int count = 0;
    for (const AovInfo& aov : aovs())
        if (isMadeBy(aov, renderer_.ran(pane)->settings))
            count += writeAov(folder, "exr", renderer_, aov, {}, pane);
    folder.writePng("picture.png", renderer_.display(pane).read<glm::u8vec4>());
    notify(state, "Saved " + std::to_string(count) + " images in " + folder.path().string());
}

std::string Workbench::curvesText() const {
    const std::string& scene = state.experiment.empty() ? state.sceneName : state.experiment;
    return toCsv(log_, {scene, nowSeed_, renderer_.size()});
}

void Workbench::saveCurves() {
    const auto path = freePath(folders_.output, "afterglow-curves", ".csv");
    writeFileAtomically(path, curvesText());
    notify(state, "Saved " + path.string());
}

void Workbench::saveTake() {
    const Transport& time = state.time;
    const Take* const take =
        time.playing ? &time.playing->take : (time.recorded ? &*time.recorded : nullptr);
    if (!take || take->frames.empty())
        throw UsageError("there is no take: I sets the in point, O the out point");
    if (!state.experiment.empty())
        throw UsageError("this take is of the experiment " + state.experiment +
                         ", which is a file already");
    Experiment base;
    const auto path = freePath(folders_.output, "afterglow-take", ".json");
    base.name = path.stem().string();
    base.description = "Recorded in the window";
    base.scene = state.sceneName;
    base.size = renderer_.size();
    base.seed = state.seed;
    base.signal = Signal(state.panes.frame.lighting.signal);
    for (const std::size_t pane : shownPanes(state.panes)) {
        Preset preset = presetOf("pane", settingsOf(state.panes, pane));
        preset.variant.name = std::string(1, letterOf(pane)) + "-" +
                              std::string(nameOf(state.panes.all[pane].settings.filter));
        base.variants.push_back(preset.variant);
    }
    // Filters settle before the take begins.
    constexpr int kLeadIn = 32;
    writeFileAtomically(path, experimentText(*take, renderer_.scene(), base, kLeadIn));
    notify(state, "Saved " + path.string() + ": afterglow experiment measures it");
}

void Workbench::savePreset(const std::string& name) {
    Preset preset = presetOf(name, settingsOf(state.panes, state.panes.active));
    preset.title = name.substr(0, kTitleLength);
    preset.description = "Saved from pane " + std::string(1, letterOf(state.panes.active));
    preset.source = "own choice";
    presets_.save(preset);
    setPane(state.panes, state.panes.active, preset.title, state.settings());
    notify(state, "Saved as " + (presets_.folder() / (name + ".json")).string());
}

void Workbench::recordFrames() {
    if (recorder_.isRecording())
        return recorder_.stop();
    const glm::ivec2 size = composedView().size();
    if (size.x == 0)
        return;
    const auto frames = state.recordFrames > 0 ? std::optional(state.recordFrames) : std::nullopt;
    recorder_.start(folders_.output, size, kRecordedRate, frames);
    notify(state, "Recording: F9 ends it");
}

void Workbench::enter(Scene scene, const std::string& sceneName, const std::string& opened) {
    state.sceneName = state.preferences.lastScene = sceneName;
    state.experiment.clear();
    if (isFile(opened))
        rememberFile(state.preferences, opened);
    enterScene(state, scene);
    replaceScene(std::move(scene));
}

void Workbench::replaceScene(Scene scene) {
    renderer_.setScene(std::move(scene));
    oracle_.end();
    capture_.clear();
    checkpoint_.reset();
    now_.reset();
    before_.reset();
    forgetMeasured();
}

void Workbench::forgetMeasured() {
    instruments_.drop();
    log_.clear();
    inspection_.reset();
    reasons_ = {};
}

void Workbench::openExperiment(const std::string& nameOrPath) {
    const Experiment wanted = loadExperiment(nameOrPath);
    StagedRun run = stagedRun(wanted);
    Take take = takeOf(wanted, run);
    if (state.frozen)
        toggleFreeze(state);
    if (!suspended_)
        suspended_ = {state, renderer_.scene()};
    enter(std::move(run.scene), wanted.scene, nameOrPath);
    state.experiment = wanted.name;

    Panes& panes = state.panes;
    panes.count = std::clamp<std::size_t>(wanted.variants.size(), 1, kFilterStates);
    for (std::size_t i = 0; i < std::min(wanted.variants.size(), panes.count); ++i) {
        const Variant& variant = wanted.variants[i];
        const Settings settings = settingsOf(variant, wanted.signal);
        if (i == 0) // all panes show one raw signal
            panes.frame.lighting = settings.lighting;
        setPane(panes, i, nameOf(variant.filter) == variant.name ? "" : variant.name, settings);
    }
    // As it is measured.
    panes.frame.display.antiAliasing = int(AntiAliasing::Off);
    panes.frame.display.autoExposure = 0;
    panes.pair = {0, 1};
    panes.layout = layoutFor(panes.count);
    panes.active = 0;
    state.resolution = {.followWindow = false, .scale = 1.0f, .fixed = wanted.size};
    state.seed = wanted.seed;
    state.time.paused = false;
    play(state.time, std::move(take), true);
    notify(state, "Plays the experiment " + wanted.name +
                      (wanted.variants.size() > panes.count ? ", its first four variants" : ""));
}

// Restores the state from before the experiment, but for preferences. Histories start anew.
void Workbench::leaveExperiment() {
    notify(state, "Left the experiment " + state.experiment);
    Suspended left = *std::exchange(suspended_, {});
    left.state.preferences = std::move(state.preferences);
    left.state.preferences.lastScene = left.state.sceneName;
    left.state.notice = std::move(state.notice);
    left.state.wanted = std::move(state.wanted);
    state = std::move(left.state);
    state.time.recording.reset();
    checkpointLost(state.time);
    state.time.resetWanted = true;
    replaceScene(std::move(left.scene));
}

bool Workbench::isExperiment(const std::string& nameOrPath) {
    if (nameOrPath.ends_with(".json"))
        return true;
    const auto known = builtInExperiments();
    return std::ranges::find(known, nameOrPath, &ExperimentInfo::name) != known.end();
}

void Workbench::open(const std::string& nameOrPath) {
    attempt([&] {
        if (isExperiment(nameOrPath))
            return openExperiment(nameOrPath);
        Scene scene = loadScene(nameOrPath);
        if (suspended_)
            leaveExperiment();
        enter(std::move(scene), nameOrPath, nameOrPath);
        notify(state, "Opened " + nameOrPath);
    });
}

void Workbench::enterTourStop(std::size_t index, glm::ivec2 view) {
    const std::vector<TourStop>& tour = tourStops();
    if (index >= tour.size()) {
        state.tourStop.reset();
        state.preferences.tourDone = true;
        return;
    }
    if (state.sceneName != tour[index].scene || !state.experiment.empty())
        open(tour[index].scene);
    forgetMeasured();
    enterStop(state, tour[index], glm::max(renderSize(state.resolution, view), glm::ivec2(1)));
    state.tourStop = index;
}

void Workbench::paste(const std::string& text) {
    attempt([&] {
        const Preset preset = parsePreset(text, "clipboard");
        setPane(state.panes, state.panes.active, preset.title,
                settingsOf(preset.variant, Signal::Both));
        notify(state, "Pasted the preset " + preset.title);
    });
}

} // namespace afterglow
