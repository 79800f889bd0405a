// SPDX-License-Identifier: MIT
// What the probes read over the last frames, and how fast each pane answers a change of light.

#include "app/ui/curves.h"
#include "app/ui/draw.h"
#include "app/ui/panels.h"
#include "app/ui/theme.h"
#include "app/ui/widgets.h"

#include <algorithm>
#include <cmath>

namespace afterglow {
namespace {

constexpr int kFewest = 60, kMost = int(ProbeLog::kFrames), kAtFirst = 240; // frames shown

std::vector<CurveLine> linesOf(const PanelContext& panel) {
    const ViewState& state = panel.state;
    std::vector<CurveLine> lines;
    for (std::size_t probe = 0; probe < kProbes; ++probe)
        for (const std::size_t pane : shownPanes(state.panes))
            if (state.probes[probe])
                lines.push_back(
                    {.pane = pane,
                     .probe = probe,
                     .values = seriesOf(panel.bench.probeLog(), probe, pane, state.curve),
                     .event = {},
                     .t50 = {},
                     .t90 = {}});
    return lines;
}

void probeTabs(const PanelContext& panel) {
    ViewState& state = panel.state;
    for (std::size_t i = 0; i < kProbes; ++i) {
        ImGui::PushID(int(i));
        const char letter[] = {letterOf(i), '\0'};
        const bool active = i == state.activeProbe, set = state.probes[i].has_value();
        const ImVec4 tint = ImGui::ColorConvertU32ToFloat4(probeColor(i));
        ImGui::PushStyleColor(ImGuiCol_Text, set ? tint : color::kFaint);
        ImGui::PushStyleColor(ImGuiCol_Button, active ? color::kFrameActive : color::kFrame);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const ImVec2 size{2.0f * em(), ImGui::GetFrameHeight()};
        if (ImGui::Button(letter, size))
            state.activeProbe = i;
        ImGui::PopStyleColor(2);
        ImDrawList& draw = *ImGui::GetWindowDrawList();
        if (set)
            drawLineSample(draw, {at.x + 0.3f * em(), at.y + size.y - 0.2f * em()},
                           size.x - 0.6f * em(), i, probeColor(i));
        if (active)
            draw.AddRect(at, {at.x + size.x, at.y + size.y}, faded(probeColor(i), 0.7f),
                         ImGui::GetStyle().FrameRounding);
        std::string help = std::string("Probe ") + letter;
        if (set) {
            const Probe& probe = state.probes[i]->probe;
            help += formatted(": %d \xc3\x97 %d pixels from %d, %d", probe.size.x, probe.size.y,
                              probe.min.x, probe.min.y);
        }
        tooltip(help + ".\nA click in the picture moves the active probe, a drag makes a box. "
                       "With Shift held, another probe; with Ctrl held, one pixel.");
        ImGui::PopID();
        ImGui::SameLine(0.0f, 0.25f * em());
    }
}

void buttons(const PanelContext& panel) {
    ViewState& state = panel.state;
    probeTabs(panel);
    ImGui::SameLine(0.0f, 0.8f * em());
    ImGui::SetNextItemWidth(10.5f * em());
    std::vector<ProbeQuantity> all;
    for (const QuantityInfo& info : quantities())
        all.push_back(info.quantity);
    choose("##quantity", state.curve, all, [](ProbeQuantity q) { return nameOf(infoOf(q)); });
    tooltip("What is drawn: the mean over the probe in every frame. Key Z: the next.");

    const float width = 12.3f * em();
    ImGui::SameLine();
    ImGui::SetCursorPosX(
        std::max(ImGui::GetWindowContentRegionMax().x - width, ImGui::GetCursorPosX()));
    actionRow(state, {control('C'), control('E'), shift('J')}, width, ButtonStyle::Quiet);
}

// All values of one frame.
void readout(const PanelContext& panel, const std::vector<CurveLine>& lines, std::size_t index) {
    const ProbeFrame& frame = panel.bench.probeLog().frames()[index];
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.8f * em(), 0.6f * em()});
    ImGui::BeginTooltip();
    std::string head = formatted("Frame %u", frame.frame);
    for (const ProbeMark& mark : frame.marks)
        head += ", " + mark.text;
    write(head);
    for (const CurveLine& line : lines) {
        ImDrawList& draw = *ImGui::GetWindowDrawList();
        const ImVec2 at = ImGui::GetCursorScreenPos();
        drawLetter(draw, at, line.pane, paneColor(line.pane));
        drawLetter(draw, {at.x + letterSize() + 0.3f * em(), at.y}, line.probe,
                   probeColor(line.probe));
        const float value = index < line.values.size() ? line.values[index] : NAN;
        draw.AddText({at.x + 3.6f * em(), std::round(at.y + 0.5f * (letterSize() - em()))},
                     packed(color::kText),
                     std::isfinite(value) ? formatted("%.4g", double(value)).c_str()
                                          : "nothing measured");
        ImGui::Dummy({11.0f * em(), letterSize()});
    }
    ImGui::EndTooltip();
    ImGui::PopStyleVar();
}

// The wheel shows more frames, or fewer. A young log is not stretched over all of them.
int framesShown(bool hovered, std::size_t known) {
    int* const frames = ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("frames shown"), kAtFirst);
    if (const float wheel = ImGui::GetIO().MouseWheel; hovered && wheel != 0.0f)
        *frames = std::clamp(int(std::lround(double(*frames) * std::pow(0.8, double(wheel)))),
                             kFewest, kMost);
    int enough = kFewest;
    while (enough < int(known))
        enough *= 2;
    return std::min(*frames, enough);
}

void body(const PanelContext& panel) {
    const ViewState& state = panel.state;
    const ImVec2 at = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
    std::vector<CurveLine> lines = linesOf(panel);
    if (lines.empty()) {
        ImGui::SetCursorScreenPos({at.x, at.y + 0.35f * room.y - 0.5f * em()});
        const std::string hint = "Click or drag a box in the picture to measure there, or press J "
                                 "at the mouse.";
        ImGui::SetCursorPosX(
            std::max(ImGui::GetCursorPosX(), 0.5f * (ImGui::GetWindowWidth() - widthOf(hint))));
        return dimWrapped(hint);
    }

    std::vector<PaneResponse> responses;
    if (state.curve == ProbeQuantity::Lit)
        for (CurveLine& line : lines) {
            if (line.probe != state.activeProbe)
                continue;
            LiveResponse response = liveResponse(panel.bench.probeLog(), line.probe, line.pane,
                                                 recordOf(state.panes, line.pane).settings);
            if (response.claimed() && !response.over) {
                line.event = line.values.size() - 1 - std::size_t(response.framesSince);
                line.t50 = response.t50;
                line.t90 = response.t90;
            }
            responses.push_back({line.pane, std::move(response)});
        }

    const float gap = 1.8f * em();
    const float table = std::clamp(0.42f * room.x, 19.4f * em(), 30.0f * em());
    const bool hasTable = room.x > table + gap + 12.0f * em() && state.probes[state.activeProbe];
    const UiRect chart{at, {hasTable ? room.x - table - gap : room.x, room.y}};
    ImGui::InvisibleButton("chart", {std::max(chart.size.x, 1.0f), std::max(chart.size.y, 1.0f)});
    const bool hovered = ImGui::IsItemHovered();
    const auto index =
        drawCurves(panel,
                   {.log = panel.bench.probeLog(),
                    .quantity = infoOf(state.curve),
                    .lines = lines,
                    .activeProbe = state.activeProbe,
                    .frames = framesShown(hovered, panel.bench.probeLog().frames().size())},
                   chart, hovered ? std::optional(ImGui::GetMousePos()) : std::nullopt);
    if (index)
        readout(panel, lines, *index);
    if (!hasTable)
        return;
    const UiRect beside{{chart.end().x + gap, at.y}, {table, room.y}};
    if (responses.empty())
        valueTable(panel, lines, beside);
    else
        responseTable(panel, responses, beside);
}

} // namespace

void dockCurves(const PanelContext& panel) {
    const UiRect where = inUnits(panel, panel.frame.layout.curves);
    drawEdge(where.min, {where.end().x, where.min.y});
    buttons(panel);
    body(panel);
}

} // namespace afterglow
