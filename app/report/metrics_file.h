#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace afterglow {

/// metrics.csv as { variant: { metric: { first: frame, values: [...] } } }; metrics in the order in
/// which they first occur. A value that is missing or not a number is null, an infinite one "inf"
/// or
/// "-inf". InputError names the file; a variant must be one of `variants`, and the frames of a
/// metric must rise.
nlohmann::ordered_json readMetrics(const std::filesystem::path& file,
                                   const std::vector<std::string>& variants);

} // namespace afterglow
