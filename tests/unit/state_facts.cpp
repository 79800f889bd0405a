// SPDX-License-Identifier: MIT
#include "state_facts.h"

#include "app/workbench/fields.h"

#include <sstream>
#include <utility>

namespace afterglow {
namespace {

template <class... Parts>
std::string text(const Parts&... parts) {
    std::ostringstream out;
    const char* gap = "";
    ((out << std::exchange(gap, " ") << std::boolalpha << parts), ...);
    return out.str();
}

std::string text(glm::ivec2 v) {
    return text(v.x, v.y);
}
std::string text(glm::vec3 v) {
    return text(v.x, v.y, v.z);
}
std::string text(const std::vector<std::string>& parts) {
    std::string all;
    for (const std::string& part : parts)
        all += (all.empty() ? "" : ", ") + part;
    return all;
}
std::string text(const std::optional<PanePixel>& pixel) {
    return pixel ? text(pixel->pane, pixel->pixel.x, pixel->pixel.y) : "none";
}
std::string text(const LightState& light) {
    return text(light.on, light.power, text(light.tint));
}
std::string text(const Take& take) {
    return text(take.name, take.frames.empty() ? 0 : take.frames.front().frame, take.frames.size());
}
std::string text(const Camera& camera) {
    const glm::quat& q = camera.orientation;
    return text(text(camera.position), q.w, q.x, q.y, q.z, camera.lens.verticalFov);
}

// Where a person would say that it is.
std::string placeOf(const ViewState& state) {
    if (state.camera == state.home)
        return "home";
    const auto places = state.preferences.bookmarks.find(state.sceneName);
    if (places != state.preferences.bookmarks.end())
        for (const CameraBookmark& place : places->second)
            if (place.position == state.camera.position)
                return place.name;
    return "elsewhere";
}

void addPanes(Facts& facts, const Panes& panes) {
    for (std::size_t i = 0; i < panes.all.size(); ++i) {
        const Pane& pane = panes.all[i];
        const std::string name = text("pane", i);
        facts[name + " title"] = pane.title;
        facts[name + " filter"] = nameOf(pane.settings.filter);
        for (const Field& field : fields())
            facts[name + " " + std::string(field.key)] =
                valueText(field, fieldValue(settingsOf(panes, i), field));
    }
    facts["layout"] = nameOf(panes.layout);
    facts["active"] = text(panes.active);
    facts["pair"] = text(panes.pair[0], panes.pair[1]);
    facts["divider"] = text(panes.divider);
    facts["gain"] = text(panes.gain);
}

void addTime(Facts& facts, const Transport& time) {
    facts["paused"] = text(time.paused);
    facts["steps left"] = text(time.stepsLeft);
    facts["frame limit"] = text(time.frameLimit);
    facts["animate"] = text(time.animate);
    facts["time step"] = text(int(time.timeStep));
    facts["frame"] = text(time.frame);
    facts["seconds"] = text(time.seconds);
    facts["repeat"] = text(time.repeat.every);
    facts["past"] = text(time.past.size());
    facts["playing"] = time.playing
                           ? text(text(time.playing->take), time.playing->next, time.playing->loops)
                           : "none";
    facts["recording"] = time.recording ? text(time.recording->frames.size()) : "none";
    facts["recorded"] = time.recorded ? text(*time.recorded) : "none";
    facts["checkpoint"] = text(time.hasCheckpoint);
    facts["takes"] = text(time.takesRecorded);
    facts["reset wanted"] = text(time.resetWanted);
    facts["restore wanted"] = text(time.restoreWanted);
    facts["checkpoint wanted"] = text(time.checkpointWanted);
}

void addScene(Facts& facts, const ViewState& state) {
    facts["scene"] = state.sceneName;
    facts["light names"] = text(state.lightNames);
    for (std::size_t i = 0; i < state.lights.size(); ++i)
        facts[text("light", i)] = text(state.lights[i]);
    facts["extent"] = text(state.extent);
    facts["camera"] = placeOf(state);
    facts["home"] = text(state.home);
    facts["camera index"] = text(state.cameraIndex);
    facts["speed"] = text(state.speed);
    facts["on path"] = text(state.onPath);
    facts["path seconds"] = text(state.pathSeconds);
    facts["repeated"] = nameOf(state.repeated, state.lightNames);
    facts["repeat every"] = text(state.repeatEvery);
    facts["marks"] = text(state.marks);
    facts["cut pending"] = text(state.cutPending);
}

void addView(Facts& facts, const ViewState& state) {
    facts["seed"] = text(state.seed);
    facts["resolution"] =
        text(state.resolution.followWindow, state.resolution.scale, text(state.resolution.fixed));
    facts["shown"] = state.shown.kind == Shown::Kind::Image
                         ? std::string(images()[state.shown.index].name)
                         : text(int(state.shown.kind), state.shown.index);
    std::string ranges;
    for (const auto& display : state.displays)
        ranges += text(display.map, display.low, display.high) + ", ";
    facts["ranges"] = ranges;
    for (std::size_t i = 0; i < kProbes; ++i)
        facts[text("probe", i)] =
            state.probes[i] ? text(text(state.probes[i]->probe.min),
                                   text(state.probes[i]->probe.size), text(state.probes[i]->image))
                            : "none";
    facts["active probe"] = text(state.activeProbe);
    facts["curve"] = infoOf(state.curve).name;
    facts["hovered"] = text(state.hovered);
    facts["inspected"] = text(state.inspected);
    facts["frozen"] = text(state.frozen);
    facts["oracle samples"] = text(state.oracleSamples);
    facts["record frames"] = text(state.recordFrames);
    facts["tour stop"] = state.tourStop ? text(*state.tourStop) : "none";
}

void addWindow(Facts& facts, const ViewState& state) {
    const Preferences& p = state.preferences;
    facts["panel"] = text(p.showPanel);
    facts["vsync"] = text(p.vsync);
    facts["preferences"] = text(text(p.windowSize), p.uiScale, p.smoothScaling, p.lastScene,
                                p.recentFiles.size(), p.tourDone);
    std::size_t places = 0;
    for (const auto& [scene, list] : p.bookmarks)
        places += list.size();
    facts["bookmarks"] = text(places);
    facts["help"] = text(state.showHelp);
    facts["inspector"] = text(state.showInspector);
    facts["curves"] = text(state.showCurves);
    facts["passes"] = text(state.showPasses);
    facts["strip"] = text(state.showStrip);
    facts["presets"] = text(state.showPresets);
    facts["notice"] = state.notice.text;
    facts["error"] = text(state.notice.isError);
    facts["keyboard in panel"] = text(state.keyboardInPanel);
    facts["quit"] = text(state.quit);
}

void addRequests(Facts& facts, const Requests& wanted) {
    facts["wants range"] = text(wanted.fitRange);
    facts["wants picture"] = text(wanted.picture);
    facts["wants window"] = text(wanted.window);
    facts["wants image files"] = text(wanted.imageFiles);
    facts["wants record"] = text(wanted.record);
    facts["wants copied curves"] = text(wanted.copyCurves);
    facts["wants saved curves"] = text(wanted.saveCurves);
    facts["wants copied preset"] = text(wanted.copyPreset);
    facts["wants pasted preset"] = text(wanted.pastePreset);
    facts["wants saved preset"] = wanted.savePreset;
    facts["wants removed preset"] = wanted.removePreset;
    facts["wants saved take"] = text(wanted.saveTake);
    facts["wants shaders"] = text(wanted.reloadShaders);
    facts["wants probe"] = text(wanted.probeAtMouse);
    facts["wants pass"] = text(wanted.passStep);
    facts["wants opened"] = wanted.open;
    facts["wants stop"] = wanted.tourStop ? text(*wanted.tourStop) : "none";
}

} // namespace

Facts factsOf(const ViewState& state) {
    Facts facts;
    addPanes(facts, state.panes);
    addTime(facts, state.time);
    addScene(facts, state);
    addView(facts, state);
    addWindow(facts, state);
    addRequests(facts, state.wanted);
    return facts;
}

std::vector<std::string> differences(const Facts& before, const Facts& after) {
    std::vector<std::string> different;
    for (const auto& [name, value] : after)
        if (before.at(name) != value)
            different.push_back(name + "=" + value);
    return different;
}

} // namespace afterglow
