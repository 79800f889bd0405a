// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/image/image.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

namespace afterglow {

/// The pictures of one variant, or of the reference.
struct SheetRow {
    std::string name;
    glm::u8vec3 color{220}; ///< sRGB; see sheetColor()
    /// Short lines below the name, and the value at the end of each: "t90", "10".
    std::vector<std::pair<std::string, std::string>> notes = {};
    /// One per column, all of one size; an empty one is left blank.
    std::vector<Image<glm::u8vec4>> pictures = {};
};

/// A quantity over frames.
struct SheetCurve {
    std::string name;
    glm::u8vec3 color{220};
    int firstFrame = 0;              ///< the frame of values[0]
    std::vector<double> values = {}; ///< one a frame; what is not finite leaves a gap
    std::optional<int> marked = {};  ///< a frame whose value gets a dot
    std::string mark = {};           ///< what is written beside it: "t90 = 10"
};

/// Curves in one frame of axes.
struct SheetPlot {
    std::string title;
    std::string xLabel = "frame", yLabel = {}; ///< the latter stands beside the title
    double yMin = 0.0, yMax = 1.0;
    /// Horizontal lines to read off: 0.9, "90 %".
    std::vector<std::pair<double, std::string>> levels = {};
    std::vector<int> events = {}; ///< frames with a vertical line
    std::vector<SheetCurve> curves = {};
};

/// Everything that is on a contact sheet: a heading, rows of pictures under column captions, and
/// below them a plot for each of `plots`. All of one width, which the pictures decide.
struct ContactSheet {
    std::string title, subtitle = {};
    std::vector<std::string> columns = {}; ///< captions, one per picture of a row
    /// The first column after the event: a line stands before it.
    std::optional<std::size_t> eventColumn = {};
    std::vector<SheetRow> rows = {};
    std::vector<SheetPlot> plots = {};
    std::string footer = {}; ///< small, at the bottom: how it was made
};

/// Draws it. Pictures wider than 320 pixels are reduced by a whole factor (averages of sRGB
/// values), ones narrower than 120 enlarged by one (without smoothing); all others are shown pixel
/// for pixel. The same sheet gives the same pixels. A row with more pictures than there are
/// columns, or pictures of unequal sizes, is a std::logic_error. Texts are UTF-8; see typeface.h.
Image<glm::u8vec4> drawContactSheet(const ContactSheet& sheet);

/// Colors that are told apart on the dark ground, by those with color-blind eyes as well: 0 is the
/// first variant; after the last they start again. The reference has kReferenceColor.
glm::u8vec3 sheetColor(std::size_t variant);
inline constexpr glm::u8vec3 kReferenceColor{214, 219, 227};

} // namespace afterglow
