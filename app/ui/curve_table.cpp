// SPDX-License-Identifier: MIT
#include "app/ui/curves.h"

#include "app/ui/theme.h"
#include "app/ui/widgets.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace afterglow {
namespace {

/// One cell of the table: a number that is to be read from afar, or a word that is not.
struct Cell {
    std::string text;
    bool isNumber = false;
};

/// The texts of one pane's row.
struct TableRow {
    std::size_t pane = 0;
    Cell cells[3];
    std::string status, help;
};

TableRow responseRow(const PanelContext& panel, std::size_t pane, const LiveResponse& response) {
    TableRow row{.pane = pane,
                 .cells = {{"\xe2\x80\x93"}, {"\xe2\x80\x93"}, {"\xe2\x80\x93"}},
                 .status = statusText(response),
                 .help = fmt::format("Pane {}, {}\n{}", letterOf(pane),
                                     titleOf(panel.state.panes, pane), describe(response))};
    if (!response.claimed())
        return row;
    for (const auto& [cell, frames] : {std::pair(0, response.t50), {1, response.t90}})
        row.cells[cell] = {timeText(response, frames), frames || response.over};
    row.cells[2] = {ghostText(response), true};
    return row;
}

constexpr const char* kHeads[] = {"t50", "t90", "ghost frames"};
constexpr const char* kHeadHelp[] = {
    "Frames until half of the change of light is shown",
    "Frames until nine tenths of it are shown, for good",
    "The sum over frames of what is still shown of the old light: 1 is a frame of all of it"};

/// Where columns are, from the left end of the table on.
struct Columns {
    float title, ends[3], status; ///< numbers are up to their ends
    bool hasTitle;
};

Columns columnsFor(float width) {
    const float letter = letterSize() + 0.5f * em();
    const float rest = letter + 17.6f * em();
    Columns columns{
        .title = letter, .ends = {}, .status = 0.0f, .hasTitle = width > rest + 4 * em()};
    float x = letter + (columns.hasTitle ? width - rest : 0.0f);
    for (std::size_t i = 0; i < 3; ++i)
        columns.ends[i] = x += i == 2 ? 5.6f * em() : 3.2f * em();
    columns.status = x + 0.9f * em();
    return columns;
}

void drawRow(const PanelContext& panel, const TableRow& row, const Columns& columns, ImVec2 at,
             float width, float height) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float middle = at.y + 0.5f * height, text = std::round(middle - 0.5f * em());
    draw.AddRectFilled(at, {at.x + width, at.y + 1.0f}, packed(color::kLine));
    drawLetter(draw, {at.x, std::round(middle - 0.5f * letterSize())}, row.pane,
               paneColor(row.pane));
    if (columns.hasTitle) {
        const float room = columns.ends[0] - 3.2f * em() - columns.title;
        draw.AddText({at.x + columns.title, text}, packed(color::kText),
                     clipped(titleOf(panel.state.panes, row.pane), room).c_str());
    }
    ImGui::PushFont(panel.fonts.small);
    draw.AddText({at.x + columns.status, std::round(middle - 0.5f * em())}, packed(color::kDim),
                 row.status.c_str());
    ImGui::PopFont();
    const bool large = height > 1.5f * panel.fonts.large->FontSize * ImGui::GetIO().FontGlobalScale;
    for (std::size_t i = 0; i < 3; ++i) {
        ImFont* const font = !row.cells[i].isNumber ? panel.fonts.text
                             : large                ? panel.fonts.large
                                                    : panel.fonts.strong;
        const WithFont letters(font);
        textUpTo(draw, {at.x + columns.ends[i], middle - 0.5f * em()},
                 row.cells[i].isNumber ? paneColor(row.pane) : packed(color::kFaint),
                 row.cells[i].text);
    }
}

} // namespace

void responseTable(const PanelContext& panel, std::span<const PaneResponse> responses,
                   const UiRect& where) {
    std::vector<TableRow> rows;
    std::string event;
    for (const auto& [pane, response] : responses) {
        rows.push_back(responseRow(panel, pane, response));
        event = response.event.empty() ? event : response.event;
    }
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const Columns columns = columnsFor(where.size.x);
    const std::size_t probe = panel.state.activeProbe;
    ImGui::PushFont(panel.fonts.small);
    const float head = 1.5f * em();
    const std::string at = std::string("at probe ") + letterOf(probe);
    const float room = columns.ends[0] - 2.4f * em();
    const std::string whole = event + " " + at;
    draw.AddText(where.min, packed(event.empty() ? color::kDim : color::kAccent),
                 widthOf(whole) <= room && !event.empty()
                     ? whole.c_str()
                     : clipped(event.empty() ? at : event, room).c_str());
    ImGui::SetCursorScreenPos(where.min);
    ImGui::Dummy({room, head});
    tooltip(event.empty() ? "No change of light yet: switch a light."
                          : "The response to \"" + event + "\" " + at);
    for (std::size_t i = 0; i < 3; ++i) {
        const float end = where.min.x + columns.ends[i], width = widthOf(kHeads[i]);
        textUpTo(draw, {end, where.min.y}, packed(color::kDim), kHeads[i]);
        ImGui::SetCursorScreenPos({end - width, where.min.y});
        ImGui::Dummy({width, head});
        tooltip(kHeadHelp[i]);
    }
    ImGui::PopFont();
    const float height =
        std::min((where.size.y - head) / float(std::max<std::size_t>(rows.size(), 1)), 3.0f * em());
    ImVec2 corner{where.min.x, where.min.y + head};
    for (const TableRow& row : rows) {
        drawRow(panel, row, columns, corner, where.size.x, height);
        ImGui::SetCursorScreenPos(corner);
        ImGui::Dummy({where.size.x, height});
        tooltip(row.help);
        corner.y += height;
    }
}

void valueTable(const PanelContext& panel, std::span<const CurveLine> lines, const UiRect& where) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const std::size_t probe = panel.state.activeProbe;
    ImGui::PushFont(panel.fonts.small);
    const float head = 1.5f * em();
    draw.AddText(where.min, packed(color::kDim),
                 (nameOf(infoOf(panel.state.curve)) + " at probe " + letterOf(probe)).c_str());
    ImGui::PopFont();
    const auto count = std::ranges::count(lines, probe, &CurveLine::probe);
    const float height =
        std::min((where.size.y - head) / float(std::max<std::ptrdiff_t>(count, 1)), 3.0f * em());
    float y = where.min.y + head;
    for (const CurveLine& line : lines) {
        if (line.probe != probe)
            continue;
        const float middle = y + 0.5f * height;
        draw.AddRectFilled({where.min.x, y}, {where.end().x, y + 1.0f}, packed(color::kLine));
        drawLetter(draw, {where.min.x, std::round(middle - 0.5f * letterSize())}, line.pane,
                   paneColor(line.pane));
        draw.AddText({where.min.x + letterSize() + 0.5f * em(), std::round(middle - 0.5f * em())},
                     packed(color::kText),
                     clipped(titleOf(panel.state.panes, line.pane), 9.0f * em()).c_str());
        const float value = line.values.empty() ? NAN : line.values.back();
        const WithFont letters(height > 2.0f * em() ? panel.fonts.large : panel.fonts.strong);
        textUpTo(draw, {where.end().x - 0.5f * em(), middle - 0.5f * em()}, paneColor(line.pane),
                 std::isfinite(value) ? formatted("%.4g", double(value)) : "\xe2\x80\x93");
        y += height;
    }
}

std::string nameOf(const QuantityInfo& quantity) {
    return std::string(quantity.name) +
           (quantity.unit.empty() ? "" : ", " + std::string(quantity.unit));
}

} // namespace afterglow
