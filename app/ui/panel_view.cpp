// SPDX-License-Identifier: MIT
// What the panes show, how large and how bright, and the truth of a frozen frame.

#include "app/ui/draw.h"
#include "app/ui/panels.h"
#include "app/ui/widgets.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <imgui.h>

namespace afterglow {
namespace {

std::string shownName(const PanelContext& panel) {
    const Shown& shown = panel.state.shown;
    if (shown.kind == Shown::Kind::Picture)
        return "picture";
    if (shown.kind == Shown::Kind::Image)
        return std::string(images()[shown.index].name);
    const auto& made = panel.bench.passes().made();
    return shown.index < made.size() ? made[shown.index].title() : "a pass";
}

void chooseImage(const PanelContext& panel) {
    ViewState& state = panel.state;
    rowLabel("Image");
    if (ImGui::BeginCombo("##image", shownName(panel).c_str(), ImGuiComboFlags_HeightLargest)) {
        if (ImGui::Selectable("picture", state.shown.kind == Shown::Kind::Picture))
            show(state, Shown::Kind::Picture);
        tooltip("The denoised picture, tone-mapped");
        for (std::size_t i = 0; i < aovs().size(); ++i) {
            const AovInfo& aov = aovs()[i];
            if (i == 0 || aov.group != aovs()[i - 1].group)
                groupTitle(panel.fonts, titleOf(aov.group).data());
            const bool made = isMadeBy(aov, state.settings());
            ImGui::PushStyleColor(ImGuiCol_Text, made ? color::kText : color::kFaint);
            const Shown wanted{Shown::Kind::Image, i};
            if (ImGui::Selectable(std::string(aov.name).c_str(), state.shown == wanted))
                state.shown = wanted;
            ImGui::PopStyleColor();
            tooltip(std::string(aov.meaning) +
                    (made ? "" : "\nThe filter of the active pane does not make it."));
        }
        ImGui::EndCombo();
    }
    tooltip("V and Shift V go through them, B returns to the picture. Names as in render --aov.");
}

// Chooses the signal whose images are shown, where a frame has several.
void chooseSignal(ViewState& state) {
    const auto signals = signalsOf(state);
    if (signals.size() < 2)
        return;
    std::vector<const char*> texts;
    for (const SignalInfo& signal : signals)
        texts.push_back(signal.name.data());
    if (const auto chosen = segments(
            "Signal", texts, int(shownSignal(state, signals.size())),
            "Whose images are shown, and whose lambda, alpha and history the probes and the "
            "inspector read. The picture is of all."))
        state.signal = std::size_t(*chosen);
}

constexpr std::array<int, 3> kMaps = {gpu::kMapScalar, gpu::kMapLogarithm, gpu::kMapSigned};

void chooseMap(ImageDisplay& display) {
    const auto now = std::ranges::find(kMaps, display.map);
    if (now == kMaps.end())
        return;
    constexpr const char* kNames[] = {"Linear", "Log", "Signed"};
    const auto chosen =
        segments("Colors", kNames, int(now - kMaps.begin()),
                 "Equal steps of color for equal steps of the value, or for equal factors, or blue "
                 "below zero and orange above.");
    if (chosen && kMaps[std::size_t(*chosen)] != display.map) {
        display.map = kMaps[std::size_t(*chosen)];
        display.high = std::max(std::abs(display.high), 1e-6f);
        if (display.map == gpu::kMapSigned)
            display.low = -display.high;
        else if (display.map == gpu::kMapLogarithm)
            display.low = display.low > 0.0f ? display.low : 1e-3f * display.high;
        else
            display.low = std::max(display.low, 0.0f);
    }
}

void chooseRange(ViewState& state, ImageDisplay& display) {
    const int ends = rangeEnds(display.map);
    if (ends == 0)
        return;
    rowLabel("Range");
    const float fit = 2.6f * em(), gap = 0.3f * em();
    ImGui::SetNextItemWidth(-fit - gap);
    const float step = std::max(std::abs(display.high), 1e-6f) * 0.01f;
    if (ends == 2) {
        const float least = display.map == gpu::kMapLogarithm ? 1e-9f : -1e9f;
        ImGui::DragFloatRange2("##range", &display.low, &display.high, step, least, 1e9f, "%.3g",
                               "%.3g", ImGuiSliderFlags_AlwaysClamp);
    } else {
        ImGui::DragFloat("##high", &display.high, step, 1e-6f, 1e9f, "%.3g",
                         ImGuiSliderFlags_AlwaysClamp);
        if (display.map == gpu::kMapSigned)
            display.low = -display.high;
    }
    tooltip("Drag, or ctrl-click to type. Values outside have the color of the end.");
    ImGui::SameLine(0.0f, gap);
    if (litButton("Fit", false, fit))
        state.wanted.fitRange = true;
    tooltip("Fits the range to this frame: all but the outermost hundredth");
}

// The truth: what is only known once the frame stands still.
void oracle(ViewState& state) {
    if (switchRow(
            "Freeze", state.frozen,
            "U. Holds this moment and converges its reference, with which the picture, lambda and "
            "alpha can be compared. The histories stay as they are."))
        toggleFreeze(state);
    chooseRow(
        "Samples", state.oracleSamples, std::array{64, 256, 1024, 4096, 16384},
        [](int samples) { return std::to_string(samples) + " a pixel"; },
        "Of the reference. Four times as many halve its noise and take four times as long.");
    if (!state.frozen)
        return;
    const float gap = 0.3f * em(), width = shareOf(3, gap);
    for (std::size_t i = aovs().size(), column = 0; i < images().size(); ++i, ++column) {
        if (column % 3 != 0)
            ImGui::SameLine(0.0f, gap);
        const Shown wanted{Shown::Kind::Image, i};
        if (litButton(images()[i].name.data(), state.shown == wanted, width))
            state.shown = wanted;
        tooltip(std::string(images()[i].meaning) + "\nShift U goes through these.");
    }
}

void chooseResolution(ViewState& state) {
    std::vector<Resolution> choices;
    for (const NamedResolution& choice : resolutions())
        choices.push_back(choice.resolution);
    const auto nameOf = [](const Resolution& resolution) {
        const auto known =
            std::ranges::find(resolutions(), resolution, &NamedResolution::resolution);
        return known != resolutions().end()
                   ? std::string(known->name)
                   : formatted("%d \xc3\x97 %d", resolution.fixed.x, resolution.fixed.y);
    };
    chooseRow(
        "Resolution", state.resolution, choices, nameOf,
        "+ and -. Pixels that are rendered, in every pane. A fixed size is scaled into the "
        "window with its proportions kept; software rendering starts with 640 \xc3\x97 360 so "
        "that it stays quick. Another size clears the history.");
}

std::string percent(float scale) {
    return scale <= 0.0f ? "as the screen" : formatted("%.0f %%", 100.0 * double(scale));
}

void screenRows(Preferences& preferences) {
    if (switchRow("Smooth scaling", preferences.smoothScaling,
                  "Off: every rendered pixel is a sharp square"))
        preferences.smoothScaling = !preferences.smoothScaling;
    if (switchRow("Wait for screen", preferences.vsync,
                  "F11. Off: frames are rendered as fast as they can be, and may tear."))
        preferences.vsync = !preferences.vsync;
    chooseRow("Size of text", preferences.uiScale,
              std::array{0.0f, 0.8f, 0.9f, 1.0f, 1.1f, 1.25f, 1.5f, 1.75f, 2.0f, 2.5f}, percent,
              "Of the whole interface. It is remembered.");
}

} // namespace

void panelView(const PanelContext& panel) {
    ViewState& state = panel.state;
    const bool picture = state.shown.kind == Shown::Kind::Picture;
    if (!section(panel.fonts, "View", true, picture ? std::string() : shownName(panel),
                 color::kAccent))
        return;
    chooseImage(panel);
    chooseSignal(panel.state);
    if (state.shown.kind == Shown::Kind::Image) {
        chooseMap(state.displays[state.shown.index]);
        chooseRange(state, state.displays[state.shown.index]);
    } else if (picture) {
        for (const Field& field : fields())
            if (field.group == "display")
                fieldRow(state.panes, field);
    }
    oracle(state);
    chooseResolution(state);
    screenRows(state.preferences);
}

} // namespace afterglow
