#pragma once

#include "app/workbench/pixel_facts.h"

#include <string>
#include <vector>

namespace afterglow {

/// What the numbers of a pixel mean, in sentences.
std::vector<std::string> storyOf(const PixelFacts& facts);

/// Four significant digits, as the inspector writes numbers.
std::string fourDigits(double value);

} // namespace afterglow
