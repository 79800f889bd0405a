// SPDX-License-Identifier: MIT
// All keys, from the table that the keyboard is read by.

#include "app/ui/draw.h"
#include "app/ui/panels.h"
#include "app/ui/widgets.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include <imgui.h>

namespace afterglow {
namespace {

// The font may lack arrows.
std::string readable(std::string_view keys) {
    std::string text{keys};
    if (ImGui::GetFont()->FindGlyphNoFallback(0x2190) == nullptr)
        for (const auto& [arrow, word] :
             {std::pair{"\xe2\x86\x90", "Left,"}, std::pair{"\xe2\x86\x92", "Right"}})
            if (const auto at = text.find(arrow); at != text.npos)
                text.replace(at, 3, word);
    return text;
}

constexpr std::size_t kHelpColumns = 3;
constexpr std::size_t kTitleRows = 2; // that the title of a group is worth
constexpr float kWidth = 63.0f;       // em, about what all of it takes

// The column of each group such that the longest is as short as can be. There are few groups: all
// ways are tried, the first group always in the first column.
std::vector<std::size_t> helpPlaces(const std::vector<KeyGroup>& groups) {
    std::vector<std::size_t> places(groups.size(), 0), best = places;
    std::size_t least = std::numeric_limits<std::size_t>::max();
    while (true) {
        std::array<std::size_t, kHelpColumns> rows{};
        for (std::size_t i = 0; i < groups.size(); ++i)
            rows[places[i]] += groups[i].rows.size() + kTitleRows;
        if (std::ranges::max(rows) < least) {
            least = std::ranges::max(rows);
            best = places;
        }
        std::size_t digit = groups.size();
        while (digit > 1 && ++places[digit - 1] == kHelpColumns)
            places[--digit] = 0;
        if (digit <= 1)
            return best;
    }
}

void helpGroup(const PanelContext& panel, const KeyGroup& group, float caps) {
    ImGui::Dummy({0.0f, 0.3f * em()});
    write(group.title, color::kAccent, panel.fonts.strong);
    for (const KeyRow& row : group.rows) {
        const float begin = ImGui::GetCursorPosX();
        keyCap(readable(row.keys));
        ImGui::SameLine();
        ImGui::SetCursorPos({begin + caps + 0.6f * em(), ImGui::GetCursorPosY() + 0.2f * em()});
        dimText(row.meaning);
    }
}

} // namespace

void overlayHelp(const PanelContext& panel) {
    if (!panel.state.showHelp)
        return;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::GetBackgroundDrawList()->AddRectFilled({0.0f, 0.0f}, screen,
                                                  packed(color::rgb(0, 0.6f)));
    const float panelEnd = inUnits(panel, panel.frame.layout.panel).end().x;
    ImGui::SetNextWindowPos(middleBeside(panelEnd, kWidth * em()), ImGuiCond_Always, {0.5f, 0.5f});
    const Overlay window("keys", {.alpha = 0.98f,
                                  .padding = {1.6f, 1.1f},
                                  .rounding = 0.7f,
                                  .hasBorder = true,
                                  .more = ImGuiWindowFlags_AlwaysAutoResize |
                                          ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoNav});
    write("Keys", color::kText, panel.fonts.large);
    const WithFont letters(panel.fonts.small);
    const auto& groups = keyGroups();
    const auto places = helpPlaces(groups);
    float caps = 0.0f;
    for (const KeyGroup& group : groups)
        for (const KeyRow& row : group.rows)
            caps = std::max(caps, ImGui::CalcTextSize(readable(row.keys).c_str()).x + 0.8f * em());
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {0.9f * em(), 0.0f});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.6f * em(), 0.18f * em()});
    if (ImGui::BeginTable("columns", int(kHelpColumns),
                          ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoPadOuterX)) {
        for (std::size_t column = 0; column < kHelpColumns; ++column) {
            ImGui::TableNextColumn();
            for (std::size_t i = 0; i < groups.size(); ++i)
                if (places[i] == column)
                    helpGroup(panel, groups[i], caps);
        }
        ImGui::EndTable();
    }
    ImGui::PopStyleVar(2);
}

} // namespace afterglow
