#pragma once

#include <span>
#include <string_view>

namespace afterglow {

/// A JSON file of assets, linked into the program.
struct EmbeddedFile {
    std::string_view name; ///< the file's name without ".json"
    std::string_view text;
};

// In alphabetical order of their names.
std::span<const EmbeddedFile> embeddedExperiments(); ///< of assets/experiments
std::span<const EmbeddedFile> embeddedPresets();     ///< of assets/presets
std::span<const EmbeddedFile> embeddedTour();        ///< of assets/tour

} // namespace afterglow
