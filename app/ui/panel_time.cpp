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
        perform(state, {Action::TogglePause});
    tooltip("P or space. While paused nothing is rendered: changes show with the next step.");
    ImGui::SameLine(0.0f, gap);
    if (litButton("Step frame", false, width))
        perform(state, {Action::StepOnce});
    tooltip("N. Renders one frame, then pauses.");
    ImGui::SameLine(0.0f, gap);
    if (litButton("Step pass", false, width))
        perform(state, {Action::NextPass});
    tooltip("The full stop key, and the comma back. Shows what the next pass of this frame made.");
}

void speedRows(Transport& t) {
    rowLabel("Speed");
    if (ImGui::BeginCombo("##speed", limitName(t.frameLimit).c_str())) {
        for (const int limit : kFrameLimits)
            if (ImGui::Selectable(limitName(limit).c_str(), limit == t.frameLimit))
                t.frameLimit = limit;
        ImGui::EndCombo();
    }
    tooltip("K slower, Shift K faster. Frames stay the same; fewer are shown a second.");
    rowLabel("Time step");
    constexpr const char* kSteps[] = {"1/60 s", "Clock"};
    if (const auto chosen = segments("step", kSteps, int(t.timeStep)))
        t.timeStep = TimeStep(*chosen);
    tooltip("How far scene time goes from frame to frame: always 1/60 s, so that a run can be "
            "repeated exactly, or like the clock.");
}

void takeButtons(ViewState& state) {
    const Transport& t = state.time;
    struct Row {
        const char *name, *help;
        bool can, lit;
        Action action;
        ImVec4 tint;
    };
    const Row rows[] = {
        {"In", "I. From here on frames are recorded, and their lights and camera with them.", true,
         t.recording.has_value(), Action::MarkIn, color::kRecording},
        {"Out", "O. Ends the recording and loops it, each round bit for bit like the one before.",
         t.recording && !t.recording->frames.empty(), false, Action::MarkOut, color::kLit},
        {"Replay", "Shift O. Loops the last take again.", t.recorded && !t.recording,
         t.playing && t.playing->loops, Action::Replay, color::kLit},
        {"Leave", "Backspace. Leaves the take; live play goes on from what is seen.",
         t.playing.has_value(), false, Action::StopTake, color::kLit},
        {"Save", "Ctrl T. Writes the take as an experiment, which 'afterglow experiment' measures.",
         t.recorded.has_value(), false, Action::SaveTake, color::kLit}};
    const float gap = 0.3f * em(), width = shareOf(5, gap);
    for (const Row& row : rows) {
        if (&row != rows)
            ImGui::SameLine(0.0f, gap);
        ImGui::BeginDisabled(!row.can);
        if (litButton(row.name, row.lit, width, row.tint))
            perform(state, {row.action});
        ImGui::EndDisabled();
        tooltip(row.help);
    }
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
    takeButtons(state);
    ImGui::PushFont(panel.fonts.small);
    ImGui::PushStyleColor(ImGuiCol_Text, t.recording ? color::kRecording
                                         : t.playing ? color::kAccent
                                                     : color::kDim);
    const std::string line = stateLine(state);
    if (clippedText(line, ImGui::GetContentRegionAvail().x))
        tooltip(line);
    ImGui::PopStyleColor();
    ImGui::PopFont();
    speedRows(state.time);
    if (litButton("Forget all history", false, ImGui::GetContentRegionAvail().x))
        perform(state, {Action::ResetHistory});
    tooltip("H. The next frame starts from nothing, as after a cut. In all panes.");
}

} // namespace afterglow
