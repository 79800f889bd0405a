#pragma once

#include <span>
#include <string_view>

namespace afterglow {

/// A file of assets/experiments, linked into the program.
struct EmbeddedExperiment {
    std::string_view name; ///< the file's name without ".json"
    std::string_view text;
};

/// In alphabetical order of their names.
std::span<const EmbeddedExperiment> embeddedExperiments();

} // namespace afterglow
