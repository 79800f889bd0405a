// SPDX-License-Identifier: MIT
// How time runs, and takes: a piece of it that plays again.

#include "app/ui/draw.h"
#include "app/ui/panels.h"
#include "app/ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

namespace afterglow {
namespace {

std::string frames(std::size_t count) {
    return std::to_string(count) + (count == 1 ? " frame" : " frames");
}

std::string stateLine(const ViewState& state) {
    const Transport& t = state.time;
    std::string line;
    if (t.playing) {
        const Playing& playing = *t.playing;
        const std::size_t count = playing.take.frames.size();
        const std::string name = playing.take.name.empty() ? "take" : playing.take.name;
        if (isFinished(t))
            line = name + " has finished: " + frames(count);
        else
            line = fmt::format("{} {}: frame {} of {}", playing.loops ? "looping" : "playing", name,
                               playing.next, count);
    }
    if (t.recording)
        return "recording " + frames(t.recording->frames.size()) +
               (line.empty() ? "" : ", " + line);
    if (!line.empty())
        return line;
    const char* const mode = state.frozen ? "frozen" : t.paused ? "paused" : "live";
    line = fmt::format("{}: frame {}, {:.2f} s", mode, t.frame > 0 ? t.frame - 1 : 0,
                       t.last ? t.last->seconds : t.seconds);
    if (t.recorded)
        line += "; " + t.recorded->name + " is kept, " + frames(t.recorded->frames.size());
    return line;
}

std::string limitName(int limit) {
    if (limit == 0)
        return "as fast as it goes";
    return std::to_string(limit) + (limit == 1 ? " frame a second" : " frames a second");
}

void stepButtons(ViewState& state) {
    const float gap = 0.3f * em(), width = shareOf(3, gap);
    const bool paused = state.time.paused || state.frozen || isFinished(state.time);
    if (litButton(paused ? "Resume###pause" : "Pause###pause", paused, width))
        press(state, plain('P'));
    tooltip(tipOf(*actionOf(plain('P'))));
    for (const char key : {'N', '.'}) {
        ImGui::SameLine(0.0f, gap);
        actionButton(state, plain(key), width);
    }
}

void speedRows(Transport& t) {
    chooseRow("Speed", t.frameLimit, kFrameLimits, limitName,
              "K slower, Shift K faster. Frames stay the same; fewer are shown a second.");
    constexpr const char* kSteps[] = {"1/60 s", "Clock"};
    if (const auto chosen = segments(
            "Time step", kSteps, int(t.timeStep),
            "How far scene time goes from frame to frame: always 1/60 s, so that a run can be "
            "repeated exactly, or like the clock."))
        t.timeStep = TimeStep(*chosen);
}

} // namespace

void panelTime(const PanelContext& panel) {
    ViewState& state = panel.state;
    const Transport& t = state.time;
    const char* const note = state.frozen    ? "frozen"
                             : t.recording   ? "recording"
                             : isFinished(t) ? "finished"
                             : t.paused      ? "paused"
                             : t.playing     ? "take"
                                             : "";
    if (!section(panel.fonts, "Time", true, note, t.recording ? color::kRecording : color::kAccent))
        return;
    stepButtons(state);
    actionRow(state, {plain('I'), plain('O'), shift('O'), {Key::Backspace}, control('T')},
              ImGui::GetContentRegionAvail().x);
    const std::string line = stateLine(state);
    const float room = ImGui::GetContentRegionAvail().x;
    {
        const WithFont letters(panel.fonts.small);
        const std::string shown = clipped(line, room);
        write(shown, t.recording ? color::kRecording : t.playing ? color::kAccent : color::kDim);
        if (shown != line)
            tooltip(line);
    }
    speedRows(state.time);
    actionButton(state, plain('H'), ImGui::GetContentRegionAvail().x);
}

} // namespace afterglow
