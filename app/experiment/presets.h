#pragma once

#include "app/experiment/variant.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace afterglow {

/// A filter with settings that somebody has published, or that was chosen by measurement: a file of
/// assets/presets.
struct Preset {
    std::string name;        ///< unique, and no filter's name
    std::string description; ///< one line
    std::string source;      ///< where its values come from
    Variant variant;         ///< under the preset's name
};

/// A preset from the text of its file; InputError as parseExperiment().
Preset parsePreset(std::string_view text, std::string_view source);

/// Those that come with the program, in alphabetical order.
std::span<const Preset> presets();

/// The filter or preset of this name; UsageError names the nearest known.
Variant variantNamed(std::string_view name);

} // namespace afterglow
