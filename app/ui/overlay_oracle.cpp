// SPDX-License-Identifier: MIT
// How far the truth of a frozen frame has converged, and what it says.

#include "app/ui/draw.h"
#include "app/ui/panels.h"
#include "app/ui/theme.h"
#include "app/ui/widgets.h"

#include <algorithm>
#include <cmath>

namespace afterglow {
namespace {

std::string frozenFrame(const ViewState& state) {
    if (state.time.past.empty())
        return "Frozen";
    return formatted("Frozen frame %u", state.time.past.back().frame);
}

void progressBar(double progress) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = 0.4f * em();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(at, {at.x + width, at.y + height}, packed(color::kFrame), 0.5f * height);
    const float done = width * float(std::clamp(progress, 0.0, 1.0));
    if (done >= height)
        draw.AddRectFilled(at, {at.x + done, at.y + height}, packed(color::kAccent), 0.5f * height);
    ImGui::Dummy({width, height});
}

// The errors of all panes that are shown, and which of the images is looked at. Its legend says
// what it means.
void results(const PanelContext& panel) {
    const ViewState& state = panel.state;
    ImGui::SameLine(0.0f, em());
    dimText("RMSE");
    for (const std::size_t pane : shownPanes(state.panes)) {
        const auto rmse = panel.bench.oracleRmse(pane);
        if (!rmse)
            continue;
        ImGui::SameLine(0.0f, 0.7f * em());
        const ImVec2 at = ImGui::GetCursorScreenPos();
        drawLetter(*ImGui::GetWindowDrawList(), {at.x, at.y - 0.15f * em()}, pane, paneColor(pane));
        ImGui::Dummy({letterSize(), em()});
        ImGui::SameLine(0.0f, 0.35f * em());
        write(formatted("%.4f", *rmse));
    }
    const std::string next = "Shift U: the next view of the truth";
    dimText(state.shown.isTruth()
                ? "shown: " + std::string(images()[state.shown.index].name) + "; " + next
                : next,
            panel.fonts.small);
}

// Above the pictures if there is room, else below the labels of the panes.
float topFor(const PanelContext& panel, const UiRect& view) {
    float pictures = view.end().y;
    bool notes = false;
    for (const PanePlace& place : panel.frame.places) {
        pictures = std::min(pictures, inUnits(panel, place.shown).min.y);
        notes = notes || !panel.bench.legend(place.pane).note.empty();
    }
    const float margin = 0.6f * em(), own = (panel.bench.oracle().isDone() ? 4.2f : 3.3f) * em();
    if (pictures >= view.min.y + own + 2.0f * margin)
        return view.min.y + margin;
    return pictures + 2.0f * margin + (notes ? 4.0f : 2.0f) * em();
}

} // namespace

void overlayOracle(const PanelContext& panel) {
    if (!panel.state.frozen)
        return;
    const UiRect view = inUnits(panel, panel.frame.layout.view);
    if (view.size.x < 18.0f * em() || view.size.y < 10.0f * em())
        return;
    const float width = std::min(27.0f * em(), view.size.x - 2.0f * em());
    ImGui::SetNextWindowPos({view.min.x + 0.5f * view.size.x, topFor(panel, view)},
                            ImGuiCond_Always, {0.5f, 0.0f});
    const bool isDone = panel.bench.oracle().isDone();
    ImGui::SetNextWindowSize({isDone ? 0.0f : width, 0.0f});
    const Overlay window(
        "oracle", {.alpha = 0.88f, .padding = {0.9f, 0.6f}, .rounding = 0.6f, .more = kUntouched});
    const OracleView& oracle = panel.bench.oracle();
    const std::string frame = frozenFrame(panel.state);
    if (isDone) {
        write(frame);
        results(panel);
    } else {
        const int samples = oracle.samples();
        const double progress = oracle.progress();
        write((frame + formatted(": reference %d of %d samples",
                                 int(std::floor(progress * samples)), samples)));
        progressBar(progress);
    }
}

} // namespace afterglow
