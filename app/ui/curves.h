// SPDX-License-Identifier: MIT
#pragma once

#include "app/measure/live_response.h"
#include "app/ui/draw.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace afterglow {

/// What one probe reads in one pane.
struct CurveLine {
    std::size_t pane = 0, probe = 0;
    std::vector<float> values;        ///< one a frame of the log; NaN where there is none
    std::optional<std::size_t> event; ///< index of the frame of a change of light that is measured
    std::optional<int> t50, t90;      ///< frames after it
};

/// The last frames of the log, the newest at the right.
struct CurveChart {
    const ProbeLog& log;
    const QuantityInfo& quantity;
    std::span<const CurveLine> lines;
    std::size_t activeProbe = 0;
    int frames = 240; ///< how many are shown
};
/// Draws it, and returns the index of the frame that the mouse is on.
std::optional<std::size_t> drawCurves(const PanelContext& panel, const CurveChart& chart,
                                      const UiRect& where, std::optional<ImVec2> mouse);

/// A line from left to right in the style of a probe, for a legend.
void drawLineSample(ImDrawList& draw, ImVec2 from, float length, std::size_t probe, ImU32 tint);

/// The response of one pane to a change of light, at the active probe.
struct PaneResponse {
    std::size_t pane = 0;
    LiveResponse response;
};
/// A row for each, with numbers that can be read from afar.
void responseTable(const PanelContext& panel, std::span<const PaneResponse> responses,
                   const UiRect& where);

/// For what has no response: the newest value of every pane at the active probe.
void valueTable(const PanelContext& panel, std::span<const CurveLine> lines, const UiRect& where);

std::string nameOf(const QuantityInfo& quantity); ///< "history, frames"

} // namespace afterglow
