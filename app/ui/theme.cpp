// SPDX-License-Identifier: MIT
#include "app/ui/theme.h"

#include "app/base/embedded.h"

#include <cmath>

namespace afterglow {
namespace {

// Latin, Greek for the formulas, the dashes and quotes of running text, arrows, and the minus.
constexpr ImWchar kGlyphs[] = {0x0020, 0x00ff, 0x0370, 0x03ff, 0x2010, 0x2027,
                               0x2190, 0x2193, 0x2212, 0x2212, 0};

ImFont* load(const EmbeddedFile& file, float pixels) {
    ImFontConfig config;
    config.OversampleH = 3;
    config.OversampleV = 2;
    config.FontDataOwnedByAtlas = false;
    // Dear ImGui does not write there.
    return ImGui::GetIO().Fonts->AddFontFromMemoryTTF(const_cast<char*>(file.bytes.data()),
                                                      int(file.bytes.size()), std::round(pixels),
                                                      &config, kGlyphs);
}

} // namespace

Fonts loadFonts(float scale) {
    const EmbeddedFile &regular = embeddedFonts()[0], &medium = embeddedFonts()[1];
    return {.text = load(regular, 15.0f * scale),
            .strong = load(medium, 15.0f * scale),
            .large = load(medium, 22.0f * scale),
            .small = load(regular, 13.0f * scale)};
}

void applyTheme(float scale) {
    ImGuiStyle style;
    style.WindowPadding = {16, 14};
    style.WindowBorderSize = 0.0f;
    style.WindowRounding = 0.0f;
    style.ChildRounding = 6.0f;
    style.FramePadding = {9, 4};
    style.FrameRounding = 5.0f;
    style.GrabRounding = 4.0f;
    style.GrabMinSize = 10.0f;
    style.PopupRounding = 6.0f;
    style.PopupBorderSize = 1.0f;
    style.ItemSpacing = {8, 5};
    style.ItemInnerSpacing = {7, 5};
    style.IndentSpacing = 12.0f;
    style.ScrollbarSize = 10.0f;
    style.ScrollbarRounding = 5.0f;
    style.DisabledAlpha = 0.4f;
    style.ScaleAllSizes(scale);

    using namespace color;
    ImVec4* const c = style.Colors;
    const ImVec4 none{0, 0, 0, 0};
    c[ImGuiCol_Text] = kText;
    c[ImGuiCol_TextDisabled] = kDim;
    c[ImGuiCol_WindowBg] = kPanel;
    c[ImGuiCol_ChildBg] = none;
    c[ImGuiCol_PopupBg] = kRaised;
    c[ImGuiCol_Border] = kLine;
    c[ImGuiCol_FrameBg] = kFrame;
    c[ImGuiCol_FrameBgHovered] = kFrameHovered;
    c[ImGuiCol_FrameBgActive] = kFrameActive;
    c[ImGuiCol_SliderGrab] = kAccentDeep;
    c[ImGuiCol_SliderGrabActive] = kAccent;
    c[ImGuiCol_CheckMark] = kAccent;
    c[ImGuiCol_Button] = kFrame;
    c[ImGuiCol_ButtonHovered] = kFrameHovered;
    c[ImGuiCol_ButtonActive] = kFrameActive;
    c[ImGuiCol_Header] = rgb(0xe9a15b, 0.16f);
    c[ImGuiCol_HeaderHovered] = rgb(0xe9a15b, 0.10f);
    c[ImGuiCol_HeaderActive] = rgb(0xe9a15b, 0.22f);
    c[ImGuiCol_Separator] = kLine;
    c[ImGuiCol_ScrollbarBg] = none;
    c[ImGuiCol_ScrollbarGrab] = kFrame;
    c[ImGuiCol_ScrollbarGrabHovered] = kFrameHovered;
    c[ImGuiCol_ScrollbarGrabActive] = kFrameActive;
    c[ImGuiCol_TextSelectedBg] = rgb(0xe9a15b, 0.35f);
    c[ImGuiCol_TableBorderLight] = kLine;
    c[ImGuiCol_TableRowBgAlt] = rgb(0xffffff, 0.02f);
    c[ImGuiCol_PlotHistogram] = kAccent;
    c[ImGuiCol_NavHighlight] = kAccent;
    ImGui::GetStyle() = style;
}

} // namespace afterglow
