// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace afterglow {

/// Returns the known name nearest to a misspelt one by edit distance, or empty if none is near.
std::string_view nearestName(std::string_view name, std::span<const std::string_view> known);

/// Returns "no filter named 'asvfg'; did you mean 'asvgf'? (known: none, fixed, ...)".
std::string unknownName(std::string_view kind, std::string_view name,
                        const std::vector<std::string_view>& known);

/// Throws UsageError with that.
[[noreturn]] void throwUnknownName(std::string_view kind, std::string_view name,
                                   std::span<const std::string_view> known);

} // namespace afterglow
