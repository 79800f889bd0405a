// SPDX-License-Identifier: MIT
#pragma once

#include "app/measure/live_response.h"
#include "app/ui/curve_chart.h"

#include <span>
#include <string>

namespace afterglow {

/// How one pane answers a change of light, at the active probe.
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
