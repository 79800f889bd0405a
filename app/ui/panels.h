#pragma once

#include "app/ui/ui.h"

namespace afterglow {

/// What panels are drawn with.
struct PanelContext {
    ViewState& state;
    const UiFrame& frame;
    const Fonts& fonts;
    float scale; ///< screen coordinates per framebuffer pixel, for positions
};

// The sections of the side panel, from top to bottom.
void panelHeader(const PanelContext& panel);
void panelFilter(const PanelContext& panel);
void panelLights(const PanelContext& panel);
void panelView(const PanelContext& panel);
void panelMotion(const PanelContext& panel);
void panelParameters(const PanelContext& panel);
void panelTimings(const PanelContext& panel);

// Over the picture.
void overlayStatus(const PanelContext& panel);
void overlayLegend(const PanelContext& panel);
void overlayNotice(const PanelContext& panel);
void overlayHelp(const PanelContext& panel);

/// "A-SVGF"; for a person, where nameOf() is for files.
const char* titleOf(Filter filter);

} // namespace afterglow
