// SPDX-License-Identifier: MIT
#pragma once

#include "app/ui/ui.h"

namespace afterglow {

/// What panels are drawn with.
struct PanelContext {
    Workbench& bench;
    ViewState& state; ///< the workbench's
    const UiFrame& frame;
    const Fonts& fonts;
    float scale; ///< screen coordinates per framebuffer pixel, for positions
};

// The sections of the side panel, from top to bottom.
void panelHeader(const PanelContext& panel);
void panelFilter(const PanelContext& panel);     ///< layout, panes, filter of the active pane
void panelLights(const PanelContext& panel);     ///< switches, and what can happen at a press
void panelTime(const PanelContext& panel);       ///< pause, step, takes, repeat
void panelView(const PanelContext& panel);       ///< image, range, resolution, freeze
void panelCamera(const PanelContext& panel);     ///< cameras, places, path, speed
void panelParameters(const PanelContext& panel); ///< every tunable of the active pane
void panelFiles(const PanelContext& panel);      ///< open, recent, pictures, recording

// In places of their own; see Layout.
void sideInspector(const PanelContext& panel);
void sidePasses(const PanelContext& panel);
void dockCurves(const PanelContext& panel);
void dockStrip(const PanelContext& panel);

// Over the pictures.
void overlayPanes(const PanelContext& panel);  ///< labels, divider, frame of the active one
void overlayProbes(const PanelContext& panel); ///< boxes of probes, the inspected pixel
void overlayStatus(const PanelContext& panel);
void overlayLegend(const PanelContext& panel);
void overlayOracle(const PanelContext& panel); ///< progress while frozen
void overlayNotice(const PanelContext& panel);
void overlayTour(const PanelContext& panel);
void overlayPresets(const PanelContext& panel); ///< presets and lineages: load, save, compare
void overlayHelp(const PanelContext& panel);

/// A color for everything that stands for a pane, or for a probe.
ImU32 paneColor(std::size_t pane);
ImU32 probeColor(std::size_t probe);

} // namespace afterglow
