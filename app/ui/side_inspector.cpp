// SPDX-License-Identifier: MIT
// Draws all that the last frame holds of one pixel.

#include "app/ui/draw.h"
#include "app/ui/panels.h"
#include "app/ui/theme.h"
#include "app/ui/widgets.h"
#include "app/workbench/inspection.h"
#include "shared/bindings.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace afterglow {
namespace {

constexpr int kMagnified = 15; // pixels along each edge of the magnifier
constexpr int kStratum = int(gpu::kStratumSize);

void heading(const PanelContext& panel, const std::string& text) {
    ImGui::Dummy({0.0f, 0.15f * em()});
    write(text, color::kText, panel.fonts.strong);
}

// Draws the pixels around one, enlarged, with the edges of strata.
void magnifier(const PanelContext& panel, const Inspection& seen) {
    const GpuTexture* const picture = panel.bench.picture(seen.state);
    if (!picture)
        return;
    const glm::ivec2 size = picture->size();
    const glm::ivec2 count = glm::min(glm::ivec2(kMagnified), size);
    // Beside the edge of the picture the pixel is not in the middle.
    const glm::ivec2 first = glm::clamp(seen.pixel - count / 2, glm::ivec2(0), size - count);
    const float cell = std::floor(11.5f * em() / float(kMagnified));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 extent{cell * float(count.x), cell * float(count.y)};
    const auto corner = [&](glm::ivec2 p) {
        return ImVec2{float(p.x) / float(size.x), float(p.y) / float(size.y)};
    };
    ImGui::Image(reinterpret_cast<ImTextureID>(std::uintptr_t(picture->id())), extent,
                 corner(first), corner(first + count));
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImU32 grid = packed(color::rgb(0x000000, 0.45f));
    for (int x = (first.x / kStratum + 1) * kStratum; x < first.x + count.x; x += kStratum)
        draw.AddRectFilled({at.x + cell * float(x - first.x), at.y},
                           {at.x + cell * float(x - first.x) + 1.0f, at.y + extent.y}, grid);
    for (int y = (first.y / kStratum + 1) * kStratum; y < first.y + count.y; y += kStratum)
        draw.AddRectFilled({at.x, at.y + cell * float(y - first.y)},
                           {at.x + extent.x, at.y + cell * float(y - first.y) + 1.0f}, grid);
    const glm::ivec2 place = seen.pixel - first;
    const ImVec2 low{at.x + cell * float(place.x), at.y + cell * float(place.y)};
    const ImVec2 high{low.x + cell + 1.0f, low.y + cell + 1.0f};
    draw.AddRect({low.x - 1.0f, low.y - 1.0f}, {high.x + 1.0f, high.y + 1.0f},
                 packed(color::rgb(0x000000, 0.8f)), 0.0f, 0, 1.0f);
    draw.AddRect(low, high, packed(color::kAccent), 0.0f, 0, 1.5f);
}

// Writes which picture the magnifier shows.
void beside(const PanelContext& panel, const Inspection& seen) {
    ImGui::SameLine(0.0f, 0.9f * em());
    ImGui::BeginGroup();
    const WithFont letters(panel.fonts.small);
    ImGui::PushTextWrapPos(0.0f);
    write(titleOf(panel.state.panes.all.at(seen.state)));
    const std::string name = panel.bench.legend(seen.state).name;
    dimText(name.empty() ? "picture" : name);
    dimText(formatted("stratum %d, %d", seen.stratum.x, seen.stratum.y));
    ImGui::Dummy({0.0f, 0.3f * em()});
    dimText(panel.state.inspected ? "Held. Ctrl I lets it go." : "Ctrl I holds this pixel.");
    ImGui::PopTextWrapPos();
    ImGui::EndGroup();
}

// Breaks a sentence into lines that end between words; Dear ImGui also ends them inside of numbers.
std::string inLines(const std::string& sentence, float width) {
    std::string lines, line;
    for (std::size_t at = 0; at < sentence.size();) {
        const std::size_t end = std::min(sentence.find(' ', at), sentence.size());
        const std::string word = sentence.substr(at, end - at);
        at = end + 1;
        if (line.empty() || widthOf(line + " " + word) <= width) {
            line += (line.empty() ? "" : " ") + word;
            continue;
        }
        lines += line + "\n";
        line = word;
    }
    return lines + line;
}

void story(const PanelContext& panel, const std::vector<std::string>& sentences) {
    if (sentences.empty())
        return;
    const float pad = 0.6f * em(), width = ImGui::GetContentRegionAvail().x;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const WithFont letters(panel.fonts.small);
    const float between = 0.35f * em();
    std::vector<std::string> texts;
    float height = 2.0f * pad - between;
    for (const std::string& sentence : sentences) {
        texts.push_back(inLines(sentence, width - 2.0f * pad));
        height += ImGui::CalcTextSize(texts.back().c_str()).y + between;
    }
    draw.AddRectFilled(at, {at.x + width, at.y + height}, packed(color::kFrame), 0.4f * em());
    float y = at.y + pad;
    for (const std::string& text : texts) {
        draw.AddText({at.x + pad, std::round(y)}, packed(color::kText), text.c_str());
        y += ImGui::CalcTextSize(text.c_str()).y + between;
    }
    ImGui::Dummy({width, height});
}

// Draws a value at the right; below its name if both have no room in one line.
void valueRow(const InspectedValue& value) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, line = 1.3f * em();
    const bool fits = widthOf(value.name) + widthOf(value.value) + em() <= width;
    ImGui::Dummy({width, fits ? line : 2.0f * line});
    if (!value.note.empty())
        tooltip(value.note);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddText({at.x, std::round(at.y + 0.1f * em())}, packed(color::kDim),
                 clipped(value.name, width).c_str());
    textUpTo(draw, {at.x + width, at.y + 0.1f * em() + (fits ? 0.0f : line)}, packed(color::kText),
             clipped(value.value, width));
}

void groups(const PanelContext& panel, const std::vector<InspectedGroup>& all) {
    for (const InspectedGroup& group : all) {
        heading(panel, group.title);
        const WithFont letters(panel.fonts.small);
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.0f, 0.1f * em()});
        for (const InspectedValue& value : group.values)
            valueRow(value);
        ImGui::PopStyleVar();
    }
}

// Draws how many there are of one reason, and their share as a bar.
void countRow(std::string_view name, std::uint32_t count, std::uint64_t all) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = 1.45f * em();
    ImGui::Dummy({width, height});
    tooltip(std::string(name) + formatted(": %u of %llu, %.3g %%", count,
                                          static_cast<unsigned long long>(all),
                                          100.0 * double(count) / double(all)));
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float label = 0.56f * width, number = 4.4f * em();
    draw.AddText({at.x, std::round(at.y + 0.1f * em())}, packed(color::kDim),
                 clipped(name, label - 0.4f * em()).c_str());
    const float room = width - label - number, half = 0.2f * em();
    const float middle = at.y + 0.5f * height;
    draw.AddRectFilled({at.x + label, middle - half}, {at.x + label + room, middle + half},
                       packed(color::kFrame), half);
    const float length = room * float(double(count) / double(all));
    if (length >= 1.0f)
        draw.AddRectFilled({at.x + label, middle - half}, {at.x + label + length, middle + half},
                           packed(color::kAccentDeep), half);
    textUpTo(draw, {at.x + width, at.y + 0.1f * em()}, packed(color::kText),
             formatted("%u", count));
}

template <class Counts, class Name>
void counts(const PanelContext& panel, const char* title, const Counts& of, Name nameOf) {
    const auto all = std::accumulate(of.begin(), of.end(), std::uint64_t(0));
    if (all == 0)
        return;
    heading(panel, title);
    const WithFont letters(panel.fonts.small);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.0f, 0.0f});
    for (std::size_t code = 0; code < of.size(); ++code)
        if (of[code] > 0)
            countRow(nameOf(code), of[code], all);
    ImGui::PopStyleVar();
}

void title(const PanelContext& panel, const std::optional<Inspection>& seen) {
    ImGui::PushFont(panel.fonts.strong);
    if (!seen) {
        write("Inspector");
    } else {
        write(formatted("Pixel %d, %d of pane", seen->pixel.x, seen->pixel.y));
        ImGui::SameLine(0.0f, 0.4f * em());
        const ImVec2 at = ImGui::GetCursorScreenPos();
        drawLetter(*ImGui::GetWindowDrawList(), {at.x, at.y - 0.15f * em()}, seen->state,
                   paneColor(seen->state));
        ImGui::Dummy({letterSize(), em()});
    }
    ImGui::PopFont();
    const float width = 4.4f * em();
    ImGui::SameLine();
    ImGui::SetCursorPos(
        {ImGui::GetWindowContentRegionMax().x - width, ImGui::GetCursorPosY() - 0.15f * em()});
    const bool held = panel.state.inspected.has_value();
    ImGui::BeginDisabled(!held && !seen);
    if (litButton(held ? "Held" : "Hold", held, width)) {
        if (held)
            panel.state.inspected.reset();
        else
            panel.state.inspected = PanePixel{seen->state, seen->pixel};
    }
    ImGui::EndDisabled();
    tooltip("Keeps this pixel although the mouse moves on. Key Ctrl I.");
}

} // namespace

void sideInspector(const PanelContext& panel) {
    const UiRect side = inUnits(panel, panel.frame.layout.side);
    drawEdge(side.min, {side.min.x, side.end().y});
    if (panel.state.showPasses) { // they are above
        const float y = ImGui::GetCursorScreenPos().y;
        drawEdge({side.min.x, y}, {side.end().x, y});
        ImGui::Dummy({0.0f, 0.3f * em()});
    }
    const std::optional<Inspection>& seen = panel.bench.inspection();
    title(panel, seen);
    ImGui::BeginChild("pixel");
    if (!seen) {
        dimWrapped("Hover a pixel of a picture to see all that the frame knows of it. Ctrl I holds "
                   "the pixel.");
    } else {
        magnifier(panel, *seen);
        beside(panel, *seen);
        story(panel, seen->story);
        groups(panel, seen->groups);
    }
    const std::size_t pane = seen ? seen->state : panel.state.panes.active;
    if (const auto reasons = panel.bench.reasons(pane)) {
        counts(panel, "History of all pixels", reasons->history,
               [](std::size_t code) { return historyReason(int(code)); });
        counts(panel, "Gradient samples of all strata", reasons->fates,
               [](std::size_t code) { return sampleFate(std::uint32_t(code)); });
    }
    ImGui::EndChild();
}

} // namespace afterglow
