// Sliders for every tunable, made from the field table.

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

} // namespace

void panelParameters(const PanelContext& panel) {
    if (!section(panel.fonts, "Parameters", true))
        return;
    ViewState& state = panel.state;
    for (const std::string_view group : groups()) {
        const int changed = changedIn(state.settings, group);
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
        if (!open)
            continue;
        for (const Field& field : fields())
            if (field.group == group)
                fieldRow(state.settings, field);
        if (changed && litButton(("Defaults##" + std::string(group)).c_str(), false,
                                 ImGui::GetContentRegionAvail().x))
            for (const Field& field : fields())
                if (field.group == group)
                    resetField(state.settings, field);
    }
}

} // namespace afterglow
