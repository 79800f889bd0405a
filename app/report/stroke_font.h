#pragma once

#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace afterglow {

/// A line through points, drawn with a round pen.
using Polyline = std::vector<glm::vec2>;

// A typeface of our own for pictures that the program draws, so that it depends on no font of the
// system: every character of ASCII as a few strokes of even width. Its unit is a seventh of the
// height of a capital; small letters are 5 high and reach down to -2. Up is positive, the baseline
// is 0.

/// The strokes of a text that begins at the origin. What is not ASCII shows as a box.
std::vector<Polyline> textStrokes(std::string_view text);

/// Where the next character would begin, without the space before it.
float textWidth(std::string_view text);

} // namespace afterglow
