// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

namespace afterglow {

/// Colors of the interface, sRGB-encoded.
namespace color {
inline ImVec4 rgb(int hex, float alpha = 1.0f) {
    return {float((hex >> 16) & 255) / 255.0f, float((hex >> 8) & 255) / 255.0f,
            float(hex & 255) / 255.0f, alpha};
}
inline const ImVec4 kPanel = rgb(0x14161a);
inline const ImVec4 kRaised = rgb(0x1b1e24);
inline const ImVec4 kFrame = rgb(0x23272f);
inline const ImVec4 kFrameHovered = rgb(0x2c313b);
inline const ImVec4 kFrameActive = rgb(0x353b47);
inline const ImVec4 kLine = rgb(0x262a32);
inline const ImVec4 kText = rgb(0xd8dbe2);
inline const ImVec4 kDim = rgb(0x8d94a3);
inline const ImVec4 kFaint = rgb(0x5d6472);
inline const ImVec4 kAccent = rgb(0xe9a15b); // the color of the sky an hour after sunset
inline const ImVec4 kLit = rgb(0xcf8a48);    ///< ground of what is on
inline const ImVec4 kAccentDeep = rgb(0x9c6531);
inline const ImVec4 kFill = rgb(0x56412b); ///< of a slider up to its value
inline const ImVec4 kOnFill = rgb(0xf2c590);
inline const ImVec4 kOnAccent = rgb(0x1a120a);
inline const ImVec4 kError = rgb(0xe06c6c);
inline const ImVec4 kGround = rgb(0x0b0c0e, 0.74f); ///< behind letters on a picture
inline const ImVec4 kRecording = rgb(0xe05656);
/// By pane and by probe: what stands for one has its color everywhere; see paneColor().
inline const ImVec4 kPanes[4] = {rgb(0xe9a15b), rgb(0x6aa9e9), rgb(0x8fcf8a), rgb(0xd58ad0)};
inline const ImVec4 kProbes[4] = {rgb(0xf2f2f2), rgb(0xe6d55a), rgb(0x67d4d4), rgb(0xf090a0)};
} // namespace color

inline ImU32 packed(ImVec4 c) {
    return ImGui::ColorConvertFloat4ToU32(c);
}

/// Fonts that the atlas of the current Dear ImGui context owns.
struct Fonts {
    ImFont* text = nullptr;
    ImFont* strong = nullptr; ///< headings
    ImFont* large = nullptr;  ///< title, main numbers
    ImFont* small = nullptr;
};

/// Loads the typeface that is linked into the program. `scale`: pixels per unit of the design.
Fonts loadFonts(float scale);

/// Sets the colors and the sizes of the current Dear ImGui context.
void applyTheme(float scale);

} // namespace afterglow
