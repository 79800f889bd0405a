// SPDX-License-Identifier: MIT
// Sliders for every tunable of the active pane, made from the field table.

#include "app/ui/draw.h"
#include "app/ui/panels.h"
#include "app/ui/widgets.h"

#include <algorithm>
#include <cctype>
#include <vector>

#include <imgui.h>

namespace afterglow {
namespace {

std::string capitalized(std::string_view word) {
    std::string name{word};
    name[0] = char(std::toupper(static_cast<unsigned char>(name[0])));
    return name;
}

std::vector<std::string_view> groups() {
    std::vector<std::string_view> names;
    for (const Field& field : fields())
        if (std::ranges::find(names, field.group) == names.end() && field.group != "display")
            names.push_back(field.group); // the view section has the display's
    return names;
}

int changedIn(const Settings& settings, std::string_view group) {
    return int(std::ranges::count_if(fields(), [&](const Field& field) {
        return field.group == group && !isDefault(settings, field);
    }));
}

void resetGroup(Panes& panes, std::string_view group) {
    for (const Field& field : fields())
        if (field.group == group)
            setField(panes, field, defaultValue(settingsOf(panes, panes.active), field));
}

void copyRow(ViewState& state) {
    Panes& panes = state.panes;
    rowLabel("Copy to");
    const float gap = 0.25f * em();
    const float width = shareOf(int(panes.count) - 1, gap);
    bool first = true;
    for (std::size_t pane = 0; pane < panes.count; ++pane) {
        if (pane == panes.active)
            continue;
        if (!first)
            ImGui::SameLine(0.0f, gap);
        first = false;
        const char name[2] = {letterOf(pane), 0};
        if (litButton(name, false, width)) {
            copyPane(panes, panes.active, pane);
            notify(state,
                   std::string("Pane ") + name + " is now like pane " + letterOf(panes.active));
        }
        tooltip(std::string("Sets pane ") + name + " to this filter and its parameters");
    }
}

} // namespace

void panelParameters(const PanelContext& panel) {
    ViewState& state = panel.state;
    Panes& panes = state.panes;
    const std::string note =
        std::string(1, letterOf(panes.active)) + "  " + titleOf(panes, panes.active);
    if (!section(panel.fonts, "Parameters", false, note, color::kPanes[panes.active]))
        return;
    if (panes.count > 1)
        copyRow(state);
    const Settings settings = settingsOf(panes, panes.active);
    for (const std::string_view group : groups()) {
        const int changed = changedIn(settings, group);
        const std::string title = capitalized(group) +
                                  (changed ? ", " + std::to_string(changed) + " changed" : "") +
                                  "###" + std::string(group);
        ImGui::SetNextItemOpen(group == "temporal", ImGuiCond_Once);
        ImGui::PushStyleColor(ImGuiCol_Text, changed ? color::kAccent : color::kDim);
        ImGui::PushStyleColor(ImGuiCol_HeaderHovered, color::kRaised);
        ImGui::PushStyleColor(ImGuiCol_HeaderActive, color::kRaised);
        const bool open = ImGui::TreeNodeEx(title.c_str(), ImGuiTreeNodeFlags_NoTreePushOnOpen |
                                                               ImGuiTreeNodeFlags_SpanAvailWidth |
                                                               ImGuiTreeNodeFlags_FramePadding);
        ImGui::PopStyleColor(3);
        if (group == "lighting" || group == "anti-aliasing")
            tooltip("The same in all panes");
        if (!open)
            continue;
        for (const Field& field : fields())
            if (field.group == group)
                fieldRow(panes, field);
        if (changed && litButton(("Defaults##" + std::string(group)).c_str(), false,
                                 ImGui::GetContentRegionAvail().x))
            resetGroup(panes, group);
    }
}

} // namespace afterglow
