// SPDX-License-Identifier: MIT
// What each key means: perform().

#include "app/workbench/view_state.h"

namespace afterglow {
namespace {

constexpr float kDividerStep = 0.02f;

void cycleOracle(ViewState& state) {
    if (!state.frozen)
        return toggleFreeze(state);
    const std::size_t first = aovs().size(), count = images().size() - first;
    const std::size_t next = state.shown.isTruth() ? state.shown.index + 1 - first : 0;
    show(state, Shown::Kind::Image, first + next % count);
}

void cycleCurve(ViewState& state) {
    state.showCurves = true;
    state.curve = ProbeQuantity((std::size_t(state.curve) + 1) % quantities().size());
}

// The program knows the size of the picture.
void probeHere(ViewState& state) {
    if (!state.hovered)
        return notify(state, "The mouse is not over a picture", true);
    state.wanted.probeAtMouse = true;
}

void pinInspector(ViewState& state) {
    state.showInspector = true;
    state.inspected = state.inspected ? std::nullopt : state.hovered;
}

// The innermost of what is open.
void dismiss(ViewState& state) {
    if (state.keyboardInPanel)
        state.keyboardInPanel = false;
    else if (state.showHelp)
        state.showHelp = false;
    else if (state.tourStop)
        state.tourStop.reset();
    else if (state.showPresets)
        state.showPresets = false;
    else
        state.inspected.reset();
}

void nextStop(ViewState& state, int step) {
    const int next = state.tourStop ? int(*state.tourStop) + step : (step > 0 ? 0 : -1);
    if (next >= 0)
        state.wanted.tourStop = std::size_t(next);
}

} // namespace

void perform(ViewState& state, const Command& command) {
    const auto slot = std::size_t(command.index);
    Transport& time = state.time;
    Requests& wanted = state.wanted;
    switch (command.action) {
    case Action::NextFilter: return cycleFilter(state, 1);
    case Action::PreviousFilter: return cycleFilter(state, -1);
    case Action::ResetHistory: time.resetWanted = true; return;
    case Action::NextLayout: return cycleLayout(state.panes, 1);
    case Action::PreviousLayout: return cycleLayout(state.panes, -1);
    case Action::NextPane: return cyclePane(state.panes, 1);
    case Action::PreviousPane: return cyclePane(state.panes, -1);
    case Action::SwapPair: return swapPair(state.panes);
    case Action::DividerLeft: return moveDivider(state.panes, -kDividerStep);
    case Action::DividerRight: return moveDivider(state.panes, kDividerStep);
    case Action::ToggleLight: return toggleLight(state, slot);
    case Action::DimLight:
    case Action::ColorLight:
    case Action::ToggleAnimation:
    case Action::CutCamera:
    case Action::ToggleCameraPath: return letHappen(state, command);
    case Action::ToggleKeyLight: return toggleKeyLight(state);
    case Action::Brighter: return changeExposure(state, 0.5f);
    case Action::Darker: return changeExposure(state, -0.5f);
    case Action::TogglePause:
        if (state.frozen) {
            toggleFreeze(state);
            time.paused = false;
            return;
        }
        return togglePause(time);
    case Action::StepOnce:
        if (state.frozen)
            toggleFreeze(state);
        return stepOnce(time);
    case Action::NextPass: ++wanted.passStep; return;
    case Action::PreviousPass: --wanted.passStep; return;
    case Action::Slower: return slower(time);
    case Action::Faster: return faster(time);
    case Action::MarkIn: return markIn(time);
    case Action::MarkOut: return markOut(time);
    case Action::Replay:
        if (state.frozen && time.recorded)
            toggleFreeze(state);
        return replay(time);
    case Action::StopTake: return stopTake(state);
    case Action::SaveTake: wanted.saveTake = true; return;
    case Action::ToggleRepeat: return toggleRepeat(state);
    case Action::GoHome: return goHome(state);
    case Action::AddBookmark: return addBookmark(state);
    case Action::GoToBookmark: return goToBookmark(state, slot);
    case Action::NextImage: return cycleImage(state, 1);
    case Action::PreviousImage: return cycleImage(state, -1);
    case Action::ShowPicture: return show(state, Shown::Kind::Picture);
    case Action::FinerPixels: state.resolution = nextResolution(state.resolution, 1); return;
    case Action::CoarserPixels: state.resolution = nextResolution(state.resolution, -1); return;
    case Action::ProbeHere: return probeHere(state);
    case Action::ClearProbes: return clearProbes(state);
    case Action::NextCurve: return cycleCurve(state);
    case Action::CopyCurves: wanted.copyCurves = true; return;
    case Action::SaveCurves: wanted.saveCurves = true; return;
    case Action::PinInspector: return pinInspector(state);
    case Action::Freeze: return toggleFreeze(state);
    case Action::NextOracle: return cycleOracle(state);
    case Action::SavePicture: wanted.picture = true; return;
    case Action::SaveWindow: wanted.window = true; return;
    case Action::SaveImageFiles: wanted.imageFiles = true; return;
    case Action::RecordFrames: wanted.record = true; return;
    case Action::CopyPreset: wanted.copyPreset = true; return;
    case Action::PastePreset: wanted.pastePreset = true; return;
    case Action::ReloadShaders: wanted.reloadShaders = true; return;
    case Action::TogglePanel: state.preferences.showPanel = !state.preferences.showPanel; return;
    case Action::ToggleInspector: state.showInspector = !state.showInspector; return;
    case Action::ToggleCurves: state.showCurves = !state.showCurves; return;
    case Action::TogglePasses: state.showPasses = !state.showPasses; return;
    case Action::ToggleStrip: state.showStrip = !state.showStrip; return;
    case Action::TogglePresets: state.showPresets = !state.showPresets; return;
    case Action::ToggleTour:
        if (state.tourStop)
            state.tourStop.reset();
        else
            wanted.tourStop = 0;
        return;
    case Action::NextStop: return nextStop(state, 1);
    case Action::PreviousStop: return nextStop(state, -1);
    case Action::ToggleVsync: state.preferences.vsync = !state.preferences.vsync; return;
    case Action::FocusPanel:
        state.keyboardInPanel = !state.keyboardInPanel && state.preferences.showPanel;
        return;
    case Action::ToggleHelp: state.showHelp = !state.showHelp; return;
    case Action::Dismiss: return dismiss(state);
    case Action::Quit: state.quit = true; return;
    }
}

} // namespace afterglow
