// SPDX-License-Identifier: MIT
// What says which picture is which pane's.

#include "app/ui/draw.h"
#include "app/ui/panels.h"
#include "app/ui/theme.h"
#include "app/ui/widgets.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace afterglow {
namespace {

// How gradient samples change what this pane sees; empty where they do not.
std::string_view placementNote(const Panes& panes, std::size_t pane) {
    if (SamplePlacement(panes.frame.lighting.gradientSamples) == SamplePlacement::Merged)
        return carriesSamples(panes) ? "merged samples" : "";
    return needsOf(panes.all[pane].settings).samples ? "extra samples" : "";
}

/// What a label says, from left to right, and a line below it.
struct Label {
    std::vector<std::size_t> letters; ///< of two panes where they are subtracted
    std::string title, details, note;
};

Label labelOf(const PanelContext& panel, std::size_t pane) {
    const Panes& panes = panel.state.panes;
    Label label{.letters = {pane},
                .title = titleOf(panes.all[pane]),
                .details = parametersOf(panes.all[pane]),
                .note = {}};
    if (panes.layout == PaneLayout::Difference) {
        label.letters = {panes.pair[0], panes.pair[1]};
        label.title =
            titleOf(panes, panes.pair[0]) + " \xe2\x80\x93 " + titleOf(panes, panes.pair[1]);
        label.details = formatted("\xc3\x97 %.3g", double(panes.gain));
    } else if (const auto placement = placementNote(panes, pane); !placement.empty()) {
        label.details += (label.details.empty() ? "" : ", ") + std::string(placement);
    }
    label.note = panel.bench.legend(pane).note;
    return label;
}

void drawLabel(const PanelContext& panel, const Label& label, ImVec2 at, float room) {
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const float pad = 0.35f * em(), gap = 0.5f * em();
    const float letter = letterSize(), minus = 0.9f * em();
    const auto letters = float(label.letters.size());
    const float first = pad + letters * letter + (letters - 1.0f) * minus;
    if (room < first + pad)
        return;

    ImGui::PushFont(panel.fonts.strong);
    const std::string title = clipped(label.title, room - first - gap - pad);
    const float titleWidth = title.empty() ? 0.0f : gap + widthOf(title);
    ImGui::PopFont();
    const float left = room - first - titleWidth - gap - pad;
    const std::string details =
        left > 4.0f * em() ? clipped(label.details, std::min(left, 34.0f * em())) : "";
    const float detailsWidth = details.empty() ? 0.0f : gap + widthOf(details);

    const float height = letter + 2.0f * pad;
    const float width = first + titleWidth + detailsWidth + (title.empty() ? pad : 1.6f * pad);
    draw.AddRectFilled(at, {at.x + width, at.y + height}, packed(color::kGround), 0.4f * em());
    float x = at.x + pad;
    const float y = at.y + pad, text = std::round(y + 0.5f * (letter - em()));
    for (std::size_t i = 0; i < label.letters.size(); ++i) {
        if (i) {
            draw.AddText({std::round(x + 0.2f * em()), text}, packed(color::kText), "\xe2\x80\x93");
            x += minus;
        }
        drawLetter(draw, {x, y}, label.letters[i], paneColor(label.letters[i]));
        x += letter;
    }
    ImGui::PushFont(panel.fonts.strong);
    draw.AddText({std::round(x + gap), text}, packed(color::kText), title.c_str());
    ImGui::PopFont();
    draw.AddText({std::round(x + titleWidth + gap), text}, packed(color::kDim), details.c_str());

    if (label.note.empty())
        return;
    ImGui::PushFont(panel.fonts.small);
    const std::string note = clipped(label.note, room - 2.0f * gap);
    if (!note.empty()) {
        const ImVec2 below{at.x, at.y + height + 0.3f * em()};
        draw.AddRectFilled(below, {below.x + widthOf(note) + 2.0f * gap, below.y + 1.6f * em()},
                           packed(color::kGround), 0.4f * em());
        draw.AddText({below.x + gap, std::round(below.y + 0.3f * em())}, packed(color::kAccent),
                     note.c_str());
    }
    ImGui::PopFont();
}

// Around a picture; in a wipe, whose pictures touch, along its upper edge.
void markActive(const PanelContext& panel, const PanePlace& place) {
    const UiRect shown = inUnits(panel, place.shown);
    const ImU32 tint = paneColor(place.pane);
    const float thick = std::max(1.5f, 0.12f * em());
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    if (panel.state.panes.layout == PaneLayout::Wipe)
        draw.AddRectFilled(shown.min, {shown.end().x, shown.min.y + thick}, tint);
    else
        draw.AddRect({shown.min.x + 0.5f * thick, shown.min.y + 0.5f * thick},
                     {shown.end().x - 0.5f * thick, shown.end().y - 0.5f * thick}, tint, 0.0f, 0,
                     thick);
}

void drawDivider(const PanelContext& panel) {
    const UiRect picture = inUnits(panel, panel.frame.places[0].picture);
    const bool near = panel.frame.pointer.onDivider;
    if (near)
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);

    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const float x = std::round(picture.min.x + panel.state.panes.divider * picture.size.x);
    const float middle = picture.min.y + 0.5f * picture.size.y;
    const ImU32 tint = packed(near ? color::kText : color::rgb(0xd8dbe2, 0.7f));
    draw.AddRectFilled({x - 2.0f, picture.min.y}, {x + 2.0f, picture.end().y},
                       packed(color::rgb(0x000000, 0.35f)));
    draw.AddRectFilled({x - 0.5f, picture.min.y}, {x + 0.5f, picture.end().y}, tint);
    const float radius = 0.75f * em(), arrow = 0.28f * em();
    if (picture.size.y < 6.0f * radius)
        return;
    draw.AddCircleFilled({x, middle}, radius, packed(color::rgb(0x14161a, 0.92f)), 32);
    draw.AddCircle({x, middle}, radius, tint, 32, 1.3f);
    for (const float side : {-1.0f, 1.0f})
        draw.AddTriangleFilled({x + side * 1.8f * arrow, middle},
                               {x + side * 0.6f * arrow, middle - arrow},
                               {x + side * 0.6f * arrow, middle + arrow}, tint);
}

} // namespace

ImU32 paneColor(std::size_t pane) {
    return packed(color::kPanes[pane % std::size(color::kPanes)]);
}

ImU32 probeColor(std::size_t probe) {
    return packed(color::kProbes[probe % std::size(color::kProbes)]);
}

void overlayPanes(const PanelContext& panel) {
    const Panes& panes = panel.state.panes;
    const auto places = panel.frame.places;
    if (places.size() > 1)
        for (const PanePlace& place : places)
            if (place.pane == panes.active && !place.shown.empty())
                markActive(panel, place);
    if (panes.layout == PaneLayout::Wipe && places.size() == 2 && !places[0].picture.empty())
        drawDivider(panel);
    for (const PanePlace& place : places) {
        const UiRect shown = inUnits(panel, place.shown);
        const float margin = 0.6f * em();
        if (place.shown.empty() || shown.size.y < 4.0f * em())
            continue;
        drawLabel(panel, labelOf(panel, place.pane),
                  {std::round(shown.min.x + margin), std::round(shown.min.y + margin)},
                  shown.size.x - 2.0f * margin);
    }
}

} // namespace afterglow
