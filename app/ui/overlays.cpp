// What lies over the picture: a line of facts, the legend of false colors, notices, the keys.

#include "app/ui/panels.h"
#include "app/ui/widgets.h"
#include "app/workbench/color_maps.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <imgui.h>

namespace afterglow {
namespace {

float em() {
    return ImGui::GetFontSize();
}

constexpr ImGuiWindowFlags kOverlay =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoInputs;

struct UiRect {
    ImVec2 min, size;
};
UiRect inUnits(const PanelContext& panel, const Rect& rect) {
    return {{float(rect.min.x) * panel.scale, float(rect.min.y) * panel.scale},
            {float(rect.size.x) * panel.scale, float(rect.size.y) * panel.scale}};
}

bool hasRoom(const PanelContext& panel) {
    const UiRect view = inUnits(panel, panel.frame.layout.view);
    return view.size.x > 18.0f * em() && view.size.y > 8.0f * em();
}

std::vector<std::string> statusParts(const PanelContext& panel) {
    const ViewState& state = panel.state;
    const UiFrame& frame = panel.frame;
    std::vector<std::string> parts;
    const auto add = [&](const char* format, auto... values) {
        char text[96];
        std::snprintf(text, sizeof text, format, values...);
        parts.emplace_back(text);
    };
    add("%s", frame.scene.name.c_str());
    add("%d \xc3\x97 %d", frame.imageSize.x, frame.imageSize.y);
    add("%s", titleOf(state.settings.filter));
    if (state.settings.filter != Filter::None)
        add("\xce\xb1 %.3g", double(state.settings.denoiser.temporal.alpha));
    add("frame %u", state.frame);
    add("%.2f s", state.seconds);
    add("%.1f ms", frame.timings.frame());
    if (frame.stats.gradientSamples)
        add("%u gradient samples", frame.stats.gradientSamples);
    if (frame.stats.invalidValues)
        add("%u INVALID VALUES", frame.stats.invalidValues);
    return parts;
}

std::string numberText(double value, std::string_view unit) {
    char text[64];
    std::snprintf(text, sizeof text, "%.3g%s%.*s", value, unit.empty() ? "" : " ", int(unit.size()),
                  unit.data());
    return text;
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
        ImGui::TextUnformatted(texts[i].c_str());
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
    const float height = 1.9f * em();
    ImGui::SetNextWindowPos({view.min.x, view.min.y + view.size.y - height});
    ImGui::SetNextWindowSize({view.size.x, height});
    ImGui::SetNextWindowBgAlpha(0.78f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.9f * em(), 0.45f * em()});
    ImGui::PushFont(panel.fonts.small);
    ImGui::Begin("status", nullptr, kOverlay);
    if (panel.state.paused) {
        ImGui::PushStyleColor(ImGuiCol_Text, color::kAccent);
        ImGui::TextUnformatted("PAUSED");
        ImGui::PopStyleColor();
        ImGui::SameLine(0.0f, 1.4f * em());
    }
    const auto parts = statusParts(panel);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (i)
            ImGui::SameLine(0.0f, 1.4f * em());
        i == 0 ? ImGui::TextUnformatted(parts[i].c_str()) : dimText(parts[i]);
    }
    const char* const hint = "F1 keys";
    const float right = view.size.x - ImGui::CalcTextSize(hint).x - 0.9f * em();
    ImGui::SameLine();
    if (ImGui::GetCursorPosX() + 1.4f * em() < right) {
        ImGui::SetCursorPosX(right);
        dimText(hint);
    } else {
        ImGui::NewLine();
    }
    ImGui::End();
    ImGui::PopFont();
    ImGui::PopStyleVar();
}

void overlayLegend(const PanelContext& panel) {
    const ViewState& state = panel.state;
    if (!state.image || !hasRoom(panel))
        return;
    const UiRect view = inUnits(panel, panel.frame.layout.view);
    const ImageDisplay& display = state.displays[*state.image];
    ImGui::SetNextWindowPos({view.min.x + view.size.x - em(), view.min.y + em()}, ImGuiCond_Always,
                            {1.0f, 0.0f});
    ImGui::SetNextWindowBgAlpha(0.86f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.45f * em());
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.8f * em(), 0.6f * em()});
    ImGui::Begin("legend", nullptr, kOverlay | ImGuiWindowFlags_AlwaysAutoResize);
    const AovInfo& aov = aovs()[*state.image];
    ImGui::PushFont(panel.fonts.strong);
    ImGui::TextUnformatted(std::string(aov.name).c_str());
    ImGui::PopFont();
    ImGui::PushFont(panel.fonts.small);
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + 17.0f * em());
    dimText(aov.meaning);
    if (shownImage(state)) {
        legendBody(display);
    } else {
        ImGui::PushStyleColor(ImGuiCol_Text, color::kAccent);
        ImGui::Text("%s does not make it: this is the picture.", titleOf(state.settings.filter));
        ImGui::PopStyleColor();
    }
    ImGui::PopTextWrapPos();
    ImGui::PopFont();
    ImGui::End();
    ImGui::PopStyleVar(2);
}

void overlayNotice(const PanelContext& panel) {
    const Notice& notice = panel.state.notice;
    const bool broken = !panel.frame.shaderErrors.empty();
    if ((notice.secondsLeft <= 0.0 && !broken) || !hasRoom(panel))
        return;
    const UiRect view = inUnits(panel, panel.frame.layout.view);
    const float fade = broken ? 1.0f : float(std::min(notice.secondsLeft, 1.0));
    ImGui::SetNextWindowPos({view.min.x + em(), view.min.y + em()});
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, std::max(fade, 0.02f));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.45f * em());
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.8f * em(), 0.6f * em()});
    ImGui::SetNextWindowBgAlpha(0.86f * fade);
    ImGui::Begin("notice", nullptr, kOverlay | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::PushTextWrapPos(std::min(0.55f * view.size.x, 42.0f * em()));
    ImGui::PushStyleColor(ImGuiCol_Text, notice.isError ? color::kError : color::kText);
    if (notice.secondsLeft > 0.0)
        ImGui::TextUnformatted(notice.text.c_str());
    ImGui::PopStyleColor();
    ImGui::PushStyleColor(ImGuiCol_Text, color::kError);
    for (const std::string& error : panel.frame.shaderErrors)
        ImGui::TextUnformatted(error.c_str());
    ImGui::PopStyleColor();
    ImGui::PopTextWrapPos();
    ImGui::End();
    ImGui::PopStyleVar(3);
}

void overlayHelp(const PanelContext& panel) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const UiRect view = inUnits(panel, panel.frame.layout.view);
    const ImVec2 end{view.min.x + view.size.x, view.min.y + view.size.y};
    ImGui::GetBackgroundDrawList()->AddRectFilled(view.min, end,
                                                  afterglow::packed(color::rgb(0, 0.6f)));
    // In the middle of the picture, or of the window if it is wider than that.
    const float middle = view.size.x > 52.0f * em() ? 0.5f * (view.min.x + end.x) : 0.5f * screen.x;
    ImGui::SetNextWindowPos({middle, 0.5f * screen.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowBgAlpha(0.97f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.7f * em());
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {1.8f * em(), 1.4f * em()});
    ImGui::Begin("keys", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoInputs);
    ImGui::PushFont(panel.fonts.large);
    ImGui::TextUnformatted("Keys");
    ImGui::PopFont();
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {1.2f * em(), 0.0f});
    if (ImGui::BeginTable("columns", 2,
                          ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoPadOuterX)) {
        std::string_view group;
        const auto help = keyHelp();
        const std::size_t half = std::size_t(
            std::ranges::find(help, std::string_view("Camera"), &KeyHelp::group) - help.begin());
        ImGui::TableNextColumn();
        for (std::size_t i = 0; i < help.size(); ++i) {
            if (i == half) {
                ImGui::TableNextColumn();
                group = {};
            }
            if (help[i].group != group) {
                group = help[i].group;
                ImGui::Dummy({0.0f, 0.2f * em()});
                ImGui::PushFont(panel.fonts.strong);
                ImGui::PushStyleColor(ImGuiCol_Text, color::kAccent);
                ImGui::TextUnformatted(std::string(group).c_str());
                ImGui::PopStyleColor();
                ImGui::PopFont();
            }
            const float begin = ImGui::GetCursorPosX();
            keyCap(help[i].keys);
            ImGui::SameLine();
            ImGui::SetCursorPos({begin + 6.5f * em(), ImGui::GetCursorPosY() + 0.2f * em()});
            dimText(help[i].meaning);
        }
        ImGui::EndTable();
    }
    ImGui::PopStyleVar();
    ImGui::End();
    ImGui::PopStyleVar(2);
}

} // namespace afterglow
