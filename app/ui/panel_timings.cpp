// Where the time goes.

#include "app/ui/panels.h"
#include "app/ui/widgets.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <imgui.h>

namespace afterglow {
namespace {

float em() {
    return ImGui::GetFontSize();
}

// A round number just above, so that the scale of the graph stays calm.
double roundedUp(double value) {
    const double power = std::pow(10.0, std::floor(std::log10(std::max(value, 1e-3))));
    for (const double step : {1.0, 2.0, 5.0, 10.0})
        if (value <= step * power)
            return step * power;
    return 10.0 * power;
}

void graph(const PassTimings& timings) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 size{ImGui::GetContentRegionAvail().x, 3.2f * em()};
    ImGui::Dummy(size);
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled(at, {at.x + size.x, at.y + size.y}, packed(color::kRaised), 0.3f * em());
    const auto& frames = timings.frames();
    if (frames.empty())
        return;
    // The slowest twentieth may stick out: a compilation must not flatten all else.
    std::vector<float> sorted(frames);
    std::ranges::sort(sorted);
    const double top = roundedUp(1.15 * double(sorted[(sorted.size() - 1) * 95 / 100]));
    const float bar = size.x / float(PassTimings::kFrames);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const float x = at.x + size.x - bar * float(frames.size() - i);
        const float h = size.y * float(std::min(double(frames[i]) / top, 1.0));
        const bool newest = i + 1 == frames.size();
        draw->AddRectFilled({x, at.y + size.y - h}, {x + std::max(bar - 1.0f, 1.0f), at.y + size.y},
                            packed(newest ? color::kAccent : color::kAccentDeep));
    }
    char label[32];
    std::snprintf(label, sizeof label, "%.4g ms", top);
    draw->AddText({at.x + 0.4f * em(), at.y + 0.2f * em()}, packed(color::kDim), label);
}

void passRow(const PassTimings::Row& row, double longest) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const float height = 1.3f * em();
    const float name = 0.42f * width, number = 3.6f * em();
    ImGui::Dummy({width, height});
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    const float y = at.y + 0.5f * (height - em());
    draw->PushClipRect(at, {at.x + name - 0.3f * em(), at.y + height}, true);
    draw->AddText({at.x, y}, packed(color::kText), row.name.c_str());
    draw->PopClipRect();
    const float room = width - name - number;
    const float length = room * float(longest > 0.0 ? row.milliseconds / longest : 0.0);
    const float half = 0.22f * em(), middle = at.y + 0.5f * height;
    draw->AddRectFilled({at.x + name, middle - half}, {at.x + name + room, middle + half},
                        packed(color::kRaised), half);
    if (length >= 1.0f)
        draw->AddRectFilled({at.x + name, middle - half}, {at.x + name + length, middle + half},
                            packed(color::kAccentDeep), half);
    char label[32];
    std::snprintf(label, sizeof label, "%.2f", row.milliseconds);
    draw->AddText({at.x + width - ImGui::CalcTextSize(label).x, y}, packed(color::kText), label);
}

} // namespace

void panelTimings(const PanelContext& panel) {
    panel.state.showTimings = section(panel.fonts, "Timings", true);
    if (!panel.state.showTimings)
        return;
    const PassTimings& timings = panel.frame.timings;
    char line[96];
    std::snprintf(line, sizeof line, "%.1f ms", timings.frame());
    ImGui::PushFont(panel.fonts.large);
    ImGui::TextUnformatted(line);
    ImGui::PopFont();
    if (timings.frame() > 0.0) {
        ImGui::SameLine(0.0f, 0.6f * em());
        ImGui::SetCursorPosY(ImGui::GetCursorPosY() + 0.35f * em());
        std::snprintf(line, sizeof line, "%.1f frames and %.2f M rays a second",
                      1000.0 / timings.frame(), panel.frame.raysPerSecond * 1e-6);
        dimText(line);
    }
    ImGui::PushFont(panel.fonts.small);
    std::snprintf(line, sizeof line, "All passes %.2f ms, %s", timings.passTotal(),
                  panel.frame.gl.softwareRasterizer ? "rendered without a GPU, by the clock"
                                                    : "by the GPU's own clock");
    dimText(line);
    ImGui::PopFont();
    graph(timings);
    ImGui::PushFont(panel.fonts.small);
    double longest = 0.0;
    for (const PassTimings::Row& row : timings.passes())
        longest = std::max(longest, row.milliseconds);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.0f, 0.1f * em()});
    for (const PassTimings::Row& row : timings.passes())
        passRow(row, longest);
    ImGui::PopStyleVar();
    ImGui::PopFont();
}

} // namespace afterglow
