// SPDX-License-Identifier: MIT
// Where the time goes, and what each pass of a frame makes.

#include "app/ui/draw.h"
#include "app/ui/panels.h"
#include "app/ui/theme.h"
#include "app/ui/widgets.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace afterglow {
namespace {

// A round number just above, so that the scale of the graph stays calm.
double roundedUp(double value) {
    const double power = std::pow(10.0, std::floor(std::log10(std::max(value, 1e-3))));
    for (const double step : {1.0, 2.0, 5.0, 10.0})
        if (value <= step * power)
            return step * power;
    return 10.0 * power;
}

// The slowest twentieth may stick out: a compilation must not flatten all else.
double mostOf(std::span<const float> values) {
    std::vector<float> sorted(values.begin(), values.end());
    std::ranges::sort(sorted);
    return double(sorted[(sorted.size() - 1) * 95 / 100]);
}

void graph(const PassTimings& timings) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 size{ImGui::GetContentRegionAvail().x, 3.2f * em()};
    ImGui::Dummy(size);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(at, {at.x + size.x, at.y + size.y}, packed(color::kRaised), 0.3f * em());
    const auto& frames = timings.frames();
    if (frames.empty())
        return;
    const double top = roundedUp(1.15 * mostOf(frames));
    const float bar = size.x / float(PassTimings::kFrames);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const float x = at.x + size.x - bar * float(frames.size() - i);
        const float h = size.y * float(std::min(double(frames[i]) / top, 1.0));
        const bool newest = i + 1 == frames.size();
        draw.AddRectFilled({x, at.y + size.y - h}, {x + std::max(bar - 1.0f, 1.0f), at.y + size.y},
                           packed(newest ? color::kAccent : color::kAccentDeep));
    }
    const std::string label = formatted("%.4g ms", top);
    const float pad = 0.35f * em();
    draw.AddRectFilled(at, {at.x + widthOf(label) + 2.0f * pad, at.y + 1.35f * em()},
                       packed(color::rgb(0x1b1e24, 0.85f)), 0.3f * em());
    draw.AddText({at.x + pad, at.y + 0.15f * em()}, packed(color::kDim), label.c_str());
}

// Its own last frames, the newest at the right.
void sparkline(std::span<const float> frames, const UiRect& where) {
    if (frames.size() < 2)
        return;
    const double top = 1.15 * mostOf(frames);
    if (top <= 0.0)
        return;
    std::vector<ImVec2> points;
    const float step = where.size.x / float(PassTimings::kFrames - 1);
    for (std::size_t i = 0; i < frames.size(); ++i)
        points.push_back(
            {where.end().x - step * float(frames.size() - 1 - i),
             where.end().y - where.size.y * float(std::min(double(frames[i]) / top, 1.0))});
    ImGui::GetWindowDrawList()->AddPolyline(points.data(), int(points.size()),
                                            packed(color::kFaint), 0, 1.0f);
}

/// All runs of the passes of one name in a frame.
struct PassRow {
    std::string name;
    std::optional<std::size_t> timing; ///< in PassTimings::passes()
    std::vector<std::size_t> images;   ///< in PassCapture::made()
};

// In the order of the frame; what is timed may be some frames older than what is listed.
std::vector<PassRow> rowsOf(const PassTimings& timings, std::span<const PassCapture::Made> made) {
    std::vector<PassRow> rows;
    const auto rowNamed = [&](const std::string& name) -> PassRow& {
        const auto found = std::ranges::find(rows, name, &PassRow::name);
        return found != rows.end() ? *found : rows.emplace_back(PassRow{name, {}, {}});
    };
    for (std::size_t i = 0; i < timings.passes().size(); ++i)
        rowNamed(timings.passes()[i].name).timing = i;
    for (std::size_t i = 0; i < made.size(); ++i)
        rowNamed(made[i].name).images.push_back(i);
    return rows;
}

// "B a-trous" is a pass of pane B.
std::optional<std::size_t> paneOf(std::string_view pass) {
    if (pass.size() < 3 || pass[1] != ' ' || pass[0] < 'A' || pass[0] >= letterOf(kPanes))
        return {};
    return std::size_t(pass[0] - 'A');
}

void passRow(const PassTimings& timings, const PassRow& row, double longest) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = 1.5f * em();
    const float name = 0.42f * width, number = 3.4f * em(), gap = 0.5f * em();
    const float spark = 0.17f * width, room = width - name - spark - number - gap;
    ImGui::Dummy({width, height});
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float y = std::round(at.y + 0.5f * (height - em())), middle = at.y + 0.5f * height;
    std::string_view words = row.name;
    float x = at.x;
    if (const auto pane = paneOf(row.name)) {
        drawLetter(draw, {x, std::round(middle - 0.5f * letterSize())}, *pane, paneColor(*pane));
        x += letterSize() + 0.35f * em();
        words.remove_prefix(2);
    }
    draw.AddText({x, y}, packed(color::kText), clipped(words, at.x + name - gap - x).c_str());
    if (!row.timing)
        return;
    const double milliseconds = timings.passes()[*row.timing].milliseconds;
    tooltip(row.name + formatted(": %.3f ms, the mean of about ten frames. The line: its last %zu "
                                 "frames, on a scale of its own.",
                                 milliseconds, PassTimings::kFrames));
    const float length = room * float(longest > 0.0 ? milliseconds / longest : 0.0);
    const float half = 0.22f * em(), left = at.x + name;
    draw.AddRectFilled({left, middle - half}, {left + room, middle + half}, packed(color::kRaised),
                       half);
    if (length >= 1.0f)
        draw.AddRectFilled({left, middle - half}, {left + length, middle + half},
                           packed(color::kAccentDeep), half);
    sparkline(timings.history(*row.timing),
              {{left + room + gap, at.y + 0.2f * height}, {spark, 0.6f * height}});
    textUpTo(draw, {at.x + width, y}, packed(color::kText), formatted("%.2f", milliseconds));
}

// "3 filtered": of the third run, where a pass runs more than once.
std::string labelOf(const PassCapture::Made& made) {
    return made.isOnly ? made.image : std::to_string(made.run) + " " + made.image;
}

void imageButtons(const PanelContext& panel, const PassRow& row, bool follow) {
    ViewState& state = panel.state;
    const auto& made = panel.bench.passes().made();
    const float gap = 0.3f * em(), indent = 0.6f * em();
    const float end = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x;
    const float begin = ImGui::GetCursorPosX() + indent;
    float x = begin;
    bool first = true;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.45f * em(), 0.12f * em()});
    for (const std::size_t index : row.images) {
        const std::string label = labelOf(made[index]);
        const float width = std::min(widthOf(label) + 0.9f * em(), end - begin);
        if (!first && x + width <= end)
            ImGui::SameLine(0.0f, 0.0f);
        else
            x = begin;
        first = false;
        ImGui::SetCursorPosX(x);
        x += width + gap;
        const bool lit = state.shown == Shown{Shown::Kind::Pass, index};
        ImGui::PushID(int(index));
        if (litButton(label.c_str(), lit, width)) {
            if (lit)
                show(state, Shown::Kind::Picture);
            else
                show(state, Shown::Kind::Pass, index);
        }
        ImGui::PopID();
        tooltip(made[index].pass() + " makes \"" + made[index].image +
                "\". Shows it as it is right after the pass; again: the picture.");
        if (lit && follow)
            ImGui::SetScrollHereY(0.5f);
    }
    ImGui::PopStyleVar();
    ImGui::Dummy({0.0f, 0.15f * em()});
}

void list(const PanelContext& panel) {
    const PassTimings& timings = panel.bench.timings();
    // Steps from the keyboard keep what is shown in sight.
    const Shown& shown = panel.state.shown;
    int* const seen = ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("seen"), -1);
    const int now = shown.kind == Shown::Kind::Pass ? int(shown.index) : -1;
    const bool follow = std::exchange(*seen, now) != now;
    double longest = 0.0;
    for (const PassTimings::Row& row : timings.passes())
        longest = std::max(longest, row.milliseconds);
    const WithFont letters(panel.fonts.small);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.0f, 0.2f * em()});
    const auto rows = rowsOf(timings, panel.bench.passes().made());
    if (rows.empty())
        dimWrapped("No frame has been listened to yet.");
    for (const PassRow& row : rows) {
        passRow(timings, row, longest);
        imageButtons(panel, row, follow);
    }
    ImGui::PopStyleVar();
}

std::string whatIsTimed(bool software) {
    return std::string("The median of fifteen frames, each from the beginning of its first pass to "
                       "the end of its last one, ") +
           (software ? "by the clock, finished before and after"
                     : "by the GPU's own clock, known some frames later") +
           ". Probes, the interface and the wait for the screen are not in it.";
}

void totals(const PanelContext& panel) {
    const PassTimings& timings = panel.bench.timings();
    write(timeText(timings), color::kText, panel.fonts.large);
    const WithFont letters(panel.fonts.small);
    const bool software = panel.bench.gl().softwareRasterizer;
    const std::string meaning = whatIsTimed(software);
    tooltip(meaning);
    if (timings.frame() > 0.0) {
        ImGui::SameLine(0.0f, 0.6f * em());
        ImGui::SetCursorPosY(ImGui::GetCursorPosY() + 0.5f * em());
        dimText(formatted("time for %.1f frames and %.2f M rays a second", 1000.0 / timings.frame(),
                          panel.bench.raysPerSecond() * 1e-6));
        tooltip(meaning);
    }
    dimText(
        formatted("All passes %.2f ms, %s", timings.passTotal(),
                  software ? "rendered without a GPU, by the clock" : "by the GPU's own clock"));
    tooltip(meaning);
    graph(timings);
    dimText("A click shows what a pass made. Step a pass: . and ,");
}

} // namespace

void sidePasses(const PanelContext& panel) {
    const UiRect side = inUnits(panel, panel.frame.layout.side);
    drawEdge(side.min, {side.min.x, side.end().y});
    totals(panel);
    ImGui::BeginChild("list");
    list(panel);
    ImGui::EndChild();
}

} // namespace afterglow
