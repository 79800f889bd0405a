// SPDX-License-Identifier: MIT
#pragma once

#include "app/report/canvas.h"
#include "app/report/contact_sheet.h"

namespace afterglow {

inline constexpr glm::u8vec3 kEventColor{255, 122, 110};

/// Draws curves in their axes. The box holds title, legend and axes; the labels of the vertical
/// axis stand to its left, and need some 90 pixels there.
void drawPlot(Canvas& canvas, const SheetPlot& plot, glm::ivec2 corner, glm::ivec2 size);

} // namespace afterglow
