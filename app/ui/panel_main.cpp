// SPDX-License-Identifier: MIT
// The title, and which filters share the view.

#include "app/ui/draw.h"
#include "app/ui/panels.h"
#include "app/ui/widgets.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

namespace afterglow {
namespace {

constexpr double kLeastGain = 0.25, kMostGain = 64.0;

// 197202 as "197 202".
std::string grouped(std::size_t number) {
    std::string digits = std::to_string(number);
    for (int at = int(digits.size()) - 3; at > 0; at -= 3)
        digits.insert(std::size_t(at), " ");
    return digits;
}

// The sections below leave room for it: the header ends where they do.
float scrollbar() {
    return ImGui::GetStyle().ScrollbarSize;
}

// What is open beside the pictures.
void panelSwitches(ViewState& state) {
    actionRow(state, {{Key::F2}, {Key::F3}, {Key::F4}, {Key::F8}},
              ImGui::GetContentRegionAvail().x - scrollbar(), ButtonStyle::Quiet);
}

void drawLayout(PaneLayout layout, ImVec2 center, ImU32 tint) {
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    const float w = 0.72f * em(), h = 0.42f * em(), line = std::max(1.0f, 0.08f * em());
    const ImVec2 low{std::round(center.x - w) + 0.5f, std::round(center.y - h) + 0.5f};
    const ImVec2 high{low.x + std::round(2.0f * w), low.y + std::round(2.0f * h)};
    const ImVec2 middle{std::round(center.x) + 0.5f, std::round(center.y) + 0.5f};
    const float shift = 0.34f * em();
    switch (layout) {
    case PaneLayout::Single: draw->AddRect(low, high, tint, 0.0f, 0, line); return;
    case PaneLayout::Wipe:
        draw->AddRectFilled(middle, high, tint);
        draw->AddRectFilled({middle.x, low.y}, high, tint);
        draw->AddRect(low, high, tint, 0.0f, 0, line);
        return;
    case PaneLayout::FourUp:
        draw->AddLine({low.x, middle.y}, {high.x, middle.y}, tint, line);
        [[fallthrough]];
    case PaneLayout::TwoUp:
        draw->AddLine({middle.x, low.y}, {middle.x, high.y}, tint, line);
        draw->AddRect(low, high, tint, 0.0f, 0, line);
        return;
    case PaneLayout::Difference: // two pictures, one on the other
        draw->AddRectFilled({low.x + 2.0f * shift, low.y + 0.5f * shift},
                            {high.x - 2.0f * shift, high.y - 0.5f * shift}, tint);
        draw->AddRect({low.x, low.y - 0.3f * shift}, {high.x - shift, high.y - 0.8f * shift}, tint,
                      0.0f, 0, line);
        draw->AddRect({low.x + shift, low.y + 0.8f * shift}, {high.x, high.y + 0.3f * shift}, tint,
                      0.0f, 0, line);
        return;
    }
}

constexpr std::string_view kLayoutHelp[kPaneLayouts] = {
    "One pane", "Wipe: two panes on one picture, with a divider to drag",
    "Two up: two panes beside each other", "Four up: all panes", "Difference of two panes"};

void layoutButtons(Panes& panes) {
    const float gap = 0.3f * em(), width = shareOf(int(kPaneLayouts), gap);
    for (std::size_t i = 0; i < kPaneLayouts; ++i) {
        const auto layout = PaneLayout(i);
        if (i > 0)
            ImGui::SameLine(0.0f, gap);
        ImGui::PushID(int(i));
        ImGui::BeginDisabled(!offersLayout(panes, layout));
        if (quietButton("##layout", panes.layout == layout, width))
            chooseLayout(panes, layout);
        ImGui::EndDisabled();
        ImGui::PopID();
        const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
        drawLayout(layout, {0.5f * (low.x + high.x), 0.5f * (low.y + high.y)},
                   packed(panes.layout == layout ? color::kOnFill : color::kText));
        tooltip(std::string(kLayoutHelp[i]) +
                ".\nT and Shift T go through the layouts. All panes see the same noise.");
    }
}

// "left" and "right", or what is subtracted from what.
const char* roleOf(const Panes& panes, std::size_t pane) {
    if (!showsPair(panes.layout))
        return "";
    const bool difference = panes.layout == PaneLayout::Difference;
    if (pane == panes.pair[0])
        return difference ? "from" : "left";
    if (pane == panes.pair[1])
        return difference ? "minus" : "right";
    return "";
}

// A letter over the title of the filter.
void paneTab(const PanelContext& panel, std::size_t pane, float width) {
    Panes& panes = panel.state.panes;
    const bool active = pane == panes.active, shown = isShown(panes, pane);
    const ImVec2 size{width, 2.9f * em()};
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (ImGui::InvisibleButton("pane", size))
        choosePane(panes, pane);
    focusRing();
    const bool hovered = ImGui::IsItemHovered();
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    const float rounding = ImGui::GetStyle().FrameRounding, pad = 0.45f * em();
    const ImVec2 end{at.x + size.x, at.y + size.y};
    draw->AddRectFilled(at, end,
                        packed(active    ? color::kFrameActive
                               : hovered ? color::kFrameHovered
                               : shown   ? color::kFrame
                                         : color::kRaised),
                        rounding);
    const ImVec4 tint = color::kPanes[pane];
    if (active)
        draw->AddRect(at, end, packed(tint), rounding, 0, std::max(1.0f, 0.1f * em()));
    const char letter[2] = {letterOf(pane), 0};
    const float top = at.y + 0.3f * em();
    draw->AddText(panel.fonts.strong, em(), {at.x + pad, top}, packed(tint), letter);
    ImGui::PushFont(panel.fonts.small);
    const char* const role = roleOf(panes, pane);
    draw->AddText({end.x - pad - ImGui::CalcTextSize(role).x, top + 0.1f * em()},
                  packed(color::kDim), role);
    const std::string title = clipped(titleOf(panes, pane), size.x - 2.0f * pad);
    draw->AddText({at.x + pad, top + 1.35f * em()}, packed(shown ? color::kText : color::kDim),
                  title.c_str());
    ImGui::PopFont();

    const std::string parameters = parametersOf(panes.all[pane]);
    tooltip("Pane " + std::string(letter) + ": " + titleOf(panes, pane) +
            (parameters.empty() ? "" : "\n" + parameters) +
            (shown ? "" : "\nA click shows it in place of the active pane.") +
            "\nG and Shift G go through the panes. Keys and this panel speak to the active one.");
}

void pairRow(Panes& panes) {
    if (!showsPair(panes.layout))
        return;
    if (panes.layout == PaneLayout::Difference) {
        rowLabel("Gain");
        double gain = panes.gain;
        const float swap = 4.2f * em();
        ImGui::SetNextItemWidth(-swap - 0.3f * em());
        if (slider("##gain", gain, {kLeastGain, kMostGain, true}, "%.3g \xc3\x97"))
            panes.gain = float(gain);
        tooltip("The difference is multiplied by it. Gray is none. Ctrl-click to type.");
        ImGui::SameLine(0.0f, 0.3f * em());
        if (litButton("Swap", false, swap))
            swapPair(panes);
    } else if (litButton("Swap left and right", false, ImGui::GetContentRegionAvail().x)) {
        swapPair(panes);
    }
    tooltip("X");
}

void filterButtons(ViewState& state) {
    const float gap = 0.3f * em();
    constexpr int kInRow = 4;
    const float width = shareOf(kInRow, gap);
    int place = 0;
    for (const Filter filter : allFilters()) {
        if (place++ % kInRow != 0)
            ImGui::SameLine(0.0f, gap);
        if (litButton(std::string(titleOf(filter)).c_str(), state.settings().filter == filter,
                      width))
            chooseFilter(state, filter);
        tooltip(std::string(describe(filter)) + "\nF and Shift F go through the filters.");
    }
    if (place % kInRow != 0)
        ImGui::SameLine(0.0f, gap);
    actionButton(state, {Key::F7}, ImGui::GetContentRegionAvail().x); // the rest of the row
}

void gradientSamples(Panes& panes) {
    const Field& field = fieldByKey("gradientSamples");
    constexpr const char* kNames[] = {"Merged", "Extra"};
    const int now = int(fieldValue(settingsOf(panes, panes.active), field));
    if (const auto chosen = segments("Gradient samples", kNames, now,
                                     std::string(field.meaning) + "\nFor all panes."))
        setField(panes, field, double(*chosen));
}

} // namespace

void panelHeader(const PanelContext& panel) {
    ViewState& state = panel.state;
    write("Afterglow", color::kAccent, panel.fonts.large);
    ImGui::SameLine();
    const float help = 2.4f * em(), tour = 3.4f * em(), gap = 0.3f * em();
    ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - scrollbar() - help - gap - tour);
    actionButton(state, {Key::F6}, tour, ButtonStyle::Quiet);
    ImGui::SameLine(0.0f, gap);
    actionButton(state, {Key::F1}, help, ButtonStyle::Quiet);

    const SceneStats& stats = panel.bench.renderer().sceneStats();
    const std::size_t lights = state.lights.size();
    const std::string facts = fmt::format("{}: {} triangles, {} light{}", panel.bench.scene().name,
                                          grouped(stats.triangles), lights, lights == 1 ? "" : "s");
    ImGui::PushStyleColor(ImGuiCol_Text, color::kDim);
    clippedText(facts, ImGui::GetContentRegionAvail().x);
    ImGui::PopStyleColor();
    const GlInfo& gl = panel.bench.gl();
    tooltip(
        fmt::format("{}\n{} instances\n{} records of the bounding volume hierarchy, built in "
                    "{:.1f} ms\n{:.1f} MiB of images\n{}\nOpenGL {}",
                    state.sceneName, stats.instances, stats.bvhRecords, stats.bvhBuildMilliseconds,
                    double(panel.bench.imageBytes()) / (1024.0 * 1024.0), gl.renderer, gl.version));
    panelSwitches(state);
    ImGui::Dummy({0.0f, 0.1f * em()});
}

void panelFilter(const PanelContext& panel) {
    if (!section(panel.fonts, "Filter", true))
        return;
    ViewState& state = panel.state;
    layoutButtons(state.panes);
    const float gap = 0.3f * em(), width = shareOf(int(state.panes.count), gap);
    for (std::size_t pane = 0; pane < state.panes.count; ++pane) {
        if (pane > 0)
            ImGui::SameLine(0.0f, gap);
        ImGui::PushID(int(pane));
        paneTab(panel, pane, width);
        ImGui::PopID();
    }
    pairRow(state.panes);
    ImGui::Dummy({0.0f, 0.05f * em()});
    filterButtons(state);
    dimWrapped(describe(state.settings().filter), panel.fonts.small);
    gradientSamples(state.panes);
}

} // namespace afterglow
