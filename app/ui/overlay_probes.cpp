// SPDX-License-Identifier: MIT
// Where in the pictures is measured and looked closely.

#include "app/ui/draw.h"
#include "app/ui/panels.h"
#include "app/ui/theme.h"
#include "shared/bindings.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace afterglow {
namespace {

constexpr float kLeastBox = 0.7f; // em; what is smaller on the screen gets a ring around it
constexpr int kStratum = int(gpu::kStratumSize);

// Light lines on a dark one are seen on every ground.
void outline(ImDrawList& draw, const UiRect& box, ImU32 tint, float thick) {
    const ImVec2 end = box.end();
    draw.AddRect({box.min.x - 1.0f, box.min.y - 1.0f}, {end.x + 1.0f, end.y + 1.0f},
                 packed(color::rgb(0, 0.65f)), 0.0f, 0, thick + 2.0f);
    draw.AddRect({box.min.x - 1.0f, box.min.y - 1.0f}, {end.x + 1.0f, end.y + 1.0f}, tint, 0.0f, 0,
                 thick);
}

void ring(ImDrawList& draw, ImVec2 center, ImU32 tint, float thick) {
    const float radius = 0.55f * em(), tick = 0.4f * em();
    const ImVec2 ways[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    for (const auto& [color, width] :
         {std::pair{packed(color::rgb(0, 0.65f)), thick + 2.0f}, std::pair{tint, thick}}) {
        draw.AddCircle(center, radius, color, 24, width);
        for (const ImVec2 way : ways)
            draw.AddLine({center.x + way.x * radius, center.y + way.y * radius},
                         {center.x + way.x * (radius + tick), center.y + way.y * (radius + tick)},
                         color, width);
    }
}

// The letter beside the upper left corner of what it names, inside the picture.
void name(ImDrawList& draw, const UiRect& shown, const UiRect& box, std::size_t probe,
          const std::string& more) {
    const float size = letterSize(), gap = 0.3f * em();
    const bool small = box.size.x < kLeastBox * em() && box.size.y < kLeastBox * em();
    const float off = small ? 0.9f * em() : 0.0f;
    ImVec2 at{box.min.x - 1.0f + off, box.min.y - size - 3.0f - off};
    if (at.y < shown.min.y + 2.8f * em()) // there is the label of the pane
        at.y = std::min(box.end().y + 3.0f + off, shown.end().y - size);
    at.x = std::clamp(at.x, shown.min.x, std::max(shown.end().x - size, shown.min.x));
    at = {std::round(at.x), std::round(at.y)};
    drawLetter(draw, at, probe, probeColor(probe));
    if (more.empty())
        return;
    const ImVec2 low{at.x + size + gap, at.y};
    draw.AddRectFilled(low, {low.x + widthOf(more) + 2.0f * gap, low.y + size},
                       packed(color::kGround), 0.25f * em());
    draw.AddText({low.x + gap, std::round(low.y + 0.5f * (size - em()))}, packed(color::kText),
                 more.c_str());
}

void drawProbe(const PanelContext& panel, const PanePlace& place, const Probe& probe,
               std::size_t index, bool dragged) {
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const UiRect shown = inUnits(panel, place.shown);
    const UiRect box = inUnits(panel, place, probe);
    const float thick = index == panel.state.activeProbe ? 2.0f : 1.2f;
    const float reach = 1.5f * em();
    if (box.end().x + reach < shown.min.x || box.min.x - reach > shown.end().x)
        return; // on the other side of the divider
    draw.PushClipRect(shown.min, shown.end(), true);
    if (box.size.x < kLeastBox * em() && box.size.y < kLeastBox * em())
        ring(draw, {box.min.x + 0.5f * box.size.x, box.min.y + 0.5f * box.size.y},
             probeColor(index), thick);
    else
        outline(draw, box, probeColor(index), thick);
    if (box.min.x < shown.end().x && box.end().x > shown.min.x)
        name(draw, shown, box, index,
             dragged ? formatted("%d \xc3\x97 %d", probe.size.x, probe.size.y) : "");
    draw.PopClipRect();
}

void drawInspected(const PanelContext& panel, const PanePlace& place, glm::ivec2 pixel) {
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const glm::ivec2 image = panel.bench.imageSize();
    const UiRect shown = inUnits(panel, place.shown);
    const UiRect one = inUnits(panel, place, Probe{pixel, glm::ivec2(1)});
    const glm::ivec2 first = pixel / kStratum * kStratum;
    const UiRect stratum =
        inUnits(panel, place, Probe{first, glm::min(glm::ivec2(kStratum), image - first)});
    draw.PushClipRect(shown.min, shown.end(), true);
    if (stratum.size.x >= 0.4f * em()) {
        outline(draw, stratum, packed(color::rgb(0xffffff, 0.75f)), 1.0f);
        if (one.size.x >= 3.0f)
            draw.AddRect(one.min, one.end(), packed(color::kAccent), 0.0f, 0, 1.5f);
    } else {
        ring(draw, {one.min.x + 0.5f * one.size.x, one.min.y + 0.5f * one.size.y},
             packed(color::kAccent), 1.2f);
    }
    draw.PopClipRect();
}

} // namespace

void overlayProbes(const PanelContext& panel) {
    const ViewState& state = panel.state;
    const glm::ivec2 image = panel.bench.imageSize();
    if (image.x < 1 || image.y < 1)
        return;
    const auto dragged = draggedProbe(panel.frame.pointer, image);
    // What the mouse is over is only drawn while it is held: the mouse shows where it is.
    const bool inspects = panel.state.showInspector && state.inspected &&
                          glm::all(glm::lessThan(state.inspected->pixel, image));
    for (const PanePlace& place : panel.frame.places) {
        if (place.shown.empty())
            continue;
        for (std::size_t i = 0; i < kProbes; ++i) {
            if (dragged && i == panel.frame.pointer.probe)
                drawProbe(panel, place, *dragged, i, true);
            else if (const auto& placed = state.probes[i])
                drawProbe(panel, place, rescaled(placed->probe, placed->image, image), i, false);
        }
        if (inspects)
            drawInspected(panel, place, state.inspected->pixel);
    }
}

} // namespace afterglow
