// SPDX-License-Identifier: MIT
// What lies over the picture: a line of facts, the legend of false colors, notices.

#include "app/ui/draw.h"
#include "app/ui/panels.h"
#include "app/ui/widgets.h"
#include "app/workbench/color_maps.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

namespace afterglow {
namespace {

constexpr float kStatusHeight = 1.9f; // em

bool hasRoom(const PanelContext& panel) {
    const UiRect view = inUnits(panel, panel.frame.layout.view);
    return view.size.x > 18.0f * em() && view.size.y > 8.0f * em();
}

// What is out of the ordinary, in the color of attention.
std::string statusFlag(const ViewState& state) {
    const Transport& t = state.time;
    if (t.recording)
        return "RECORDING";
    if (state.frozen)
        return "FROZEN";
    if (isFinished(t))
        return "FINISHED";
    if (t.paused)
        return "PAUSED";
    if (t.playing)
        return t.playing->loops ? "LOOP" : "TAKE";
    return {};
}

std::vector<std::string> statusParts(const PanelContext& panel) {
    const ViewState& state = panel.state;
    const FrameStats& stats = panel.bench.stats();
    const glm::ivec2 size = panel.bench.imageSize();
    std::vector<std::string> parts;
    const auto add = [&](const char* format, auto... values) {
        parts.push_back(formatted(format, values...));
    };
    add("%s", panel.bench.scene().name.c_str());
    add("%d \xc3\x97 %d", size.x, size.y);
    parts.push_back(titleOf(state.panes, state.panes.active));
    if (state.time.last) {
        add("frame %u", state.time.past.empty() ? 0u : state.time.past.back().frame);
        add("%.2f s", state.time.last->seconds);
    }
    parts.push_back(timeText(panel.bench.timings()));
    if (stats.invalidValues)
        add("%u INVALID VALUES", stats.invalidValues);
    if (stats.gradientSamples)
        add("%u gradient samples", stats.gradientSamples);
    if (state.hovered)
        add("%c at %d, %d", letterOf(state.hovered->pane), state.hovered->pixel.x,
            state.hovered->pixel.y);
    return parts;
}

std::string numberText(double value, std::string_view unit) {
    return fmt::format("{:.3g}{}{}", value, unit.empty() ? "" : " ", unit);
}

ImU32 packed(glm::vec3 c) {
    return afterglow::packed(ImVec4(c.r, c.g, c.b, 1.0f));
}

void scaleBar(const ImageDisplay& display) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 size{15.0f * em(), 0.75f * em()};
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    const bool isSigned = display.map == gpu::kMapSigned;
    constexpr int pieces = 60;
    for (int i = 0; i < pieces; ++i) {
        const auto colorAt = [&](int piece) {
            const float t = float(piece) / float(pieces);
            return packed(isSigned ? signedColor(2.0f * t - 1.0f) : scalarColor(t));
        };
        const float x0 = at.x + size.x * float(i) / float(pieces);
        const float x1 = at.x + size.x * float(i + 1) / float(pieces);
        draw->AddRectFilledMultiColor({x0, at.y}, {x1, at.y + size.y}, colorAt(i), colorAt(i + 1),
                                      colorAt(i + 1), colorAt(i));
    }
    ImGui::Dummy(size);

    const double low = display.low, high = display.high;
    const double middle = display.map == gpu::kMapLogarithm ? std::sqrt(std::max(low * high, 0.0))
                                                            : 0.5 * (low + high);
    const std::string texts[] = {numberText(low, ""), numberText(middle, ""),
                                 numberText(high, display.unit.size() <= 8 ? display.unit : "")};
    const float begin = ImGui::GetCursorPosX();
    for (int i = 0; i < 3; ++i) {
        const float width = ImGui::CalcTextSize(texts[i].c_str()).x;
        if (i)
            ImGui::SameLine();
        ImGui::SetCursorPosX(begin + 0.5f * float(i) * (size.x - width));
        write(texts[i]);
    }
}

void legendBody(const ImageDisplay& display) {
    switch (display.map) {
    case gpu::kMapScalar:
    case gpu::kMapLogarithm:
    case gpu::kMapSigned: scaleBar(display); break;
    case gpu::kMapRadiance: dimText("White is " + numberText(display.high, "")); break;
    case gpu::kMapVector:
        dimText("Red, green, blue are x, y, z from " + numberText(display.low, "") + " to " +
                numberText(display.high, display.unit));
        break;
    case gpu::kMapRepeat:
        dimText("Colors start anew every " + numberText(display.high, display.unit));
        break;
    case gpu::kMapDirection:
        dimText("Hue is the direction; brightest at " + numberText(display.high, display.unit));
        break;
    case gpu::kMapNumber: dimText("A color for every number; 0 is dark"); break;
    }
}

} // namespace

void overlayStatus(const PanelContext& panel) {
    if (!hasRoom(panel))
        return;
    const UiRect view = inUnits(panel, panel.frame.layout.view);
    const float height = kStatusHeight * em();
    ImGui::SetNextWindowPos({view.min.x, view.min.y + view.size.y - height});
    ImGui::SetNextWindowSize({view.size.x, height});
    const Overlay window(
        "status", {.alpha = 0.78f, .padding = {0.9f, 0.45f}, .rounding = 0.0f, .more = kUntouched});
    const WithFont letters(panel.fonts.small);
    const char* const hint = "F1 keys";
    const float room = view.size.x - ImGui::CalcTextSize(hint).x - 2.3f * em();
    const std::string flag = statusFlag(panel.state);
    if (!flag.empty()) {
        write(flag, panel.state.time.recording ? color::kRecording : color::kAccent);
        ImGui::SameLine(0.0f, 1.4f * em());
    }
    const auto parts = statusParts(panel);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (ImGui::GetCursorPosX() + ImGui::CalcTextSize(parts[i].c_str()).x > room)
            break; // whole parts or none
        write(parts[i], i == 0 ? color::kText : color::kDim);
        ImGui::SameLine(0.0f, 1.4f * em());
    }
    ImGui::SetCursorPosX(view.size.x - ImGui::CalcTextSize(hint).x - 0.9f * em());
    dimText(hint);
}

void overlayLegend(const PanelContext& panel) {
    if (panel.state.shown.kind == Shown::Kind::Picture || !hasRoom(panel))
        return;
    const PictureLegend legend = panel.bench.legend(panel.state.panes.active);
    if (legend.name.empty())
        return;
    const UiRect view = inUnits(panel, panel.frame.layout.view);
    ImGui::SetNextWindowPos(
        {view.min.x + view.size.x - em(), view.min.y + view.size.y - kStatusHeight * em() - em()},
        ImGuiCond_Always, {1.0f, 1.0f});
    const Overlay window("legend", {.alpha = 0.86f,
                                    .padding = {0.8f, 0.6f},
                                    .more = kUntouched | ImGuiWindowFlags_AlwaysAutoResize});
    write(legend.name, color::kText, panel.fonts.strong);
    const WithFont letters(panel.fonts.small);
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + 17.0f * em());
    if (!legend.meaning.empty())
        dimText(legend.meaning);
    if (legend.note.empty() && legend.display) // the pane's label has the note
        legendBody(*legend.display);
    ImGui::PopTextWrapPos();
}

void overlayNotice(const PanelContext& panel) {
    const Notice& notice = panel.state.notice;
    const auto errors = panel.bench.shaderErrors();
    const bool broken = !errors.empty();
    if ((notice.secondsLeft <= 0.0 && !broken) || !hasRoom(panel))
        return;
    const UiRect view = inUnits(panel, panel.frame.layout.view);
    const float fade = broken ? 1.0f : float(std::min(notice.secondsLeft, 1.0));
    ImGui::SetNextWindowPos(
        {view.min.x + em(), view.min.y + view.size.y - kStatusHeight * em() - em()},
        ImGuiCond_Always, {0.0f, 1.0f});
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, std::max(fade, 0.02f));
    {
        const Overlay window("notice", {.alpha = 0.86f * fade,
                                        .padding = {0.8f, 0.6f},
                                        .more = kUntouched | ImGuiWindowFlags_AlwaysAutoResize});
        ImGui::PushTextWrapPos(std::min(0.55f * view.size.x, 42.0f * em()));
        if (notice.secondsLeft > 0.0)
            write(notice.text, notice.isError ? color::kError : color::kText);
        for (const std::string& error : errors)
            write(error, color::kError);
        ImGui::PopTextWrapPos();
    }
    ImGui::PopStyleVar();
}

} // namespace afterglow
