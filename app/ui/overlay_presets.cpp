// SPDX-License-Identifier: MIT
// Presets: filters with the parameters of papers and of other programs, and the user's own.

#include "app/ui/draw.h"
#include "app/ui/panels.h"
#include "app/ui/widgets.h"

#include <algorithm>

#include <imgui.h>
#include <imgui_stdlib.h>

namespace afterglow {
namespace {

constexpr float kWidth = 58.0f, kHeight = 34.0f, kListWidth = 15.0f; // em

std::string letter(std::size_t pane) {
    return std::string(1, letterOf(pane));
}

Settings settingsOf(const Preset& preset) {
    return afterglow::settingsOf(preset.variant, Signal::Both);
}

std::string shownTitle(const PresetStore::Entry& entry) {
    return entry.preset.title.empty() ? entry.preset.name : entry.preset.title;
}

void listRow(const PresetStore::Entry& entry, int index, int& chosen) {
    ImGui::PushID(index);
    const bool broken = !entry.error.empty();
    ImGui::PushStyleColor(ImGuiCol_Text, broken            ? color::kError
                                         : index == chosen ? color::kText
                                                           : color::kDim);
    if (ImGui::Selectable(shownTitle(entry).c_str(), index == chosen))
        chosen = index;
    ImGui::PopStyleColor();
    tooltip(broken ? entry.error : entry.preset.name);
    ImGui::PopID();
}

void presetList(const PanelContext& panel, std::span<const PresetStore::Entry> entries,
                int& chosen) {
    ImGui::BeginChild("list", {kListWidth * em(), 0.0f}, false, ImGuiWindowFlags_NavFlattened);
    groupTitle(panel.fonts, "Built in");
    for (std::size_t i = 0; i < entries.size(); ++i)
        if (entries[i].builtIn)
            listRow(entries[i], int(i), chosen);
    ImGui::Dummy({0.0f, 0.2f * em()});
    groupTitle(panel.fonts, "Yours");
    bool any = false;
    for (std::size_t i = 0; i < entries.size(); ++i)
        if (!entries[i].builtIn) {
            listRow(entries[i], int(i), chosen);
            any = true;
        }
    if (!any) {
        dimWrapped("None yet: save a pane below, or paste one.", panel.fonts.small);
    }
    ImGui::EndChild();
}

void differences(const PanelContext& panel, const Preset& preset, float height) {
    const Panes& panes = panel.state.panes;
    const Pane& active = panes.all[panes.active];
    const auto rows = differencesOf(Settings{{}, active.settings}, settingsOf(preset));
    const std::string pane = "pane " + letter(panes.active);
    if (rows.empty())
        return dimWrapped("No difference: " + pane + " is set to exactly this.");
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {0.5f * em(), 0.18f * em()});
    if (ImGui::BeginTable("differences", 3,
                          ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerH |
                              ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingStretchProp,
                          {0.0f, height})) {
        ImGui::TableSetupScrollFreeze(0, 1);
        ImGui::TableSetupColumn("", 0, 2.0f);
        ImGui::TableSetupColumn("", 0, 1.0f);
        ImGui::TableSetupColumn("", 0, 1.0f);
        ImGui::TableNextColumn();
        dimText(std::to_string(rows.size()) + (rows.size() == 1 ? " difference" : " differences"),
                panel.fonts.small);
        ImGui::TableNextColumn();
        write(pane + " now", color::kPanes[panes.active], panel.fonts.small);
        ImGui::TableNextColumn();
        dimText("preset", panel.fonts.small);
        for (const SettingDifference& row : rows) {
            ImGui::TableNextColumn();
            dimText(row.label);
            if (row.key != "filter")
                tooltip(std::string(fieldByKey(row.key).meaning));
            ImGui::TableNextColumn();
            write(row.valueA);
            ImGui::TableNextColumn();
            write(row.valueB);
        }
        ImGui::EndTable();
    }
    ImGui::PopStyleVar();
}

void removeButton(const PanelContext& panel, const std::string& name, float width) {
    if (litButton("Remove", false, width))
        ImGui::OpenPopup("remove");
    tooltip("Removes the file of this preset");
    if (!ImGui::BeginPopup("remove", ImGuiWindowFlags_NoMove))
        return;
    write("Remove the preset " + name + "?");
    if (litButton("Remove it", true, 6.5f * em(), color::kError)) {
        panel.state.wanted.removePreset = name;
        ImGui::CloseCurrentPopup();
    }
    ImGui::SameLine();
    if (litButton("Keep it", false, 6.5f * em()))
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

void useButtons(const PanelContext& panel, const PresetStore::Entry& entry) {
    ViewState& state = panel.state;
    const float gap = 0.3f * em();
    ImGui::AlignTextToFramePadding();
    write("Use in pane");
    for (std::size_t pane = 0; pane < state.panes.count; ++pane) {
        ImGui::SameLine(0.0f, pane == 0 ? 0.7f * em() : gap);
        if (litButton(letter(pane).c_str(), pane == state.panes.active, 2.6f * em(),
                      color::kPanes[pane])) {
            setPane(state.panes, pane, shownTitle(entry), settingsOf(entry.preset));
            notify(state, "Pane " + letter(pane) + ": " + shownTitle(entry));
        }
        tooltip("Sets pane " + letter(pane) + ", which is " + titleOf(state.panes, pane) +
                " now. Lighting and exposure stay as they are.");
    }
    if (entry.builtIn)
        return;
    const float width = 5.5f * em();
    ImGui::SameLine(ImGui::GetContentRegionMax().x - width);
    removeButton(panel, entry.preset.name, width);
}

void chosenPreset(const PanelContext& panel, const PresetStore::Entry& entry) {
    ImGui::BeginChild("chosen", {0.0f, 0.0f}, false, ImGuiWindowFlags_NavFlattened);
    write(shownTitle(entry), color::kText, panel.fonts.strong);
    ImGui::PushTextWrapPos(0.0f);
    if (!entry.error.empty()) {
        write(entry.error, color::kError);
        ImGui::PopTextWrapPos();
        removeButton(panel, entry.preset.name, 5.5f * em());
        return ImGui::EndChild();
    }
    if (!entry.preset.description.empty())
        write(entry.preset.description);
    if (!entry.preset.source.empty())
        dimText("Values from: " + entry.preset.source, panel.fonts.small);
    if (entry.builtIn)
        dimText("On the command line: --filter " + entry.preset.name, panel.fonts.small);
    ImGui::PopTextWrapPos();
    ImGui::Dummy({0.0f, 0.2f * em()});
    const float line = ImGui::GetFrameHeightWithSpacing();
    differences(panel, entry.preset, ImGui::GetContentRegionAvail().y - line - 0.4f * em());
    ImGui::SetCursorPosY(ImGui::GetWindowContentRegionMax().y - ImGui::GetFrameHeight());
    useButtons(panel, entry);
    ImGui::EndChild();
}

void saveRow(const PanelContext& panel) {
    ViewState& state = panel.state;
    const PresetStore& store = panel.bench.presets();
    static std::string name; // typed and not saved yet
    const float gap = 0.4f * em(), button = 5.0f * em();
    ImGui::AlignTextToFramePadding();
    write("Save pane " + letter(state.panes.active) + " as");
    ImGui::SameLine(0.0f, 0.7f * em());
    ImGui::SetNextItemWidth(13.0f * em());
    bool save =
        ImGui::InputTextWithHint("##name", "a name", &name, ImGuiInputTextFlags_EnterReturnsTrue);
    const auto entries = store.list();
    const auto known = std::ranges::find(
        entries, name, [](const PresetStore::Entry& entry) { return entry.preset.name; });
    const bool taken = known != entries.end() && known->builtIn;
    const bool fits = isPresetName(name) && !taken;
    tooltip(taken ? "A preset of this name comes with the program."
                  : "Letters, digits, - and _; not the name of a filter. Return saves it.");
    ImGui::SameLine(0.0f, gap);
    ImGui::BeginDisabled(!fits);
    save |= litButton(known != entries.end() && !taken ? "Replace###save" : "Save###save", false,
                      button);
    ImGui::EndDisabled();
    tooltip("As a file in " + store.folder().string());
    if (save && fits)
        state.wanted.savePreset = name;
    else if (save && !name.empty())
        notify(state, "'" + name + "' cannot name a preset", true);
    ImGui::SameLine(ImGui::GetContentRegionMax().x - 2.0f * button - gap);
    actionRow(state, {{keyOf('C'), true, true}, {keyOf('V'), true, true}}, 2.0f * button + gap,
              ButtonStyle::Quiet);
}

} // namespace

void overlayPresets(const PanelContext& panel) {
    ViewState& state = panel.state;
    if (!state.showPresets)
        return;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const ImVec2 size{std::min(kWidth * em(), screen.x - 2.0f * em()),
                      std::min(kHeight * em(), screen.y - 2.0f * em())};
    const float panelEnd = inUnits(panel, panel.frame.layout.panel).end().x;
    ImGui::SetNextWindowPos(middleBeside(panelEnd, size.x), ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize(size);
    const Overlay window(
        "presets", {.alpha = 0.98f, .padding = {1.4f, 1.1f}, .rounding = 0.7f, .hasBorder = true});
    ImGui::PushStyleVar(ImGuiStyleVar_ChildRounding, 0.0f);
    write("Presets", color::kText, panel.fonts.large);
    const float close = 4.6f * em();
    ImGui::SameLine(ImGui::GetContentRegionMax().x - close);
    if (litButton("Close", false, close))
        state.showPresets = false;
    tooltip("F7 or Esc");
    dimText("A filter with all its parameters, as published, as in another program, or your own.");
    ImGui::Dummy({0.0f, 0.2f * em()});

    const auto entries = panel.bench.presets().list();
    ImGuiStorage* const storage = ImGui::GetStateStorage();
    const ImGuiID id = ImGui::GetID("chosen preset");
    int chosen = std::clamp(storage->GetInt(id, 0), 0, std::max(int(entries.size()) - 1, 0));
    const float below = ImGui::GetFrameHeightWithSpacing() + 0.9f * em();
    ImGui::BeginChild("both", {0.0f, -below}, false, ImGuiWindowFlags_NavFlattened);
    presetList(panel, entries, chosen);
    storage->SetInt(id, chosen);
    ImGui::SameLine(0.0f, 1.2f * em());
    if (!entries.empty())
        chosenPreset(panel, entries[std::size_t(chosen)]);
    ImGui::EndChild();
    ImGui::Separator();
    ImGui::Dummy({0.0f, 0.1f * em()});
    saveRow(panel);
    ImGui::PopStyleVar();
}

} // namespace afterglow
