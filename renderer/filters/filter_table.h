// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/filters/filter.h"

namespace afterglow {

/// A filter as everything else knows it.
struct FilterInfo {
    Filter filter;
    std::string_view name;     ///< on the command line and in files
    std::string_view title;    ///< for a person
    std::string_view sentence; ///< what it does
    const FilterFamily& family;
};

/// One row a filter, in the order of the enumeration.
std::span<const FilterInfo> filterTable();

const FilterInfo& infoOf(Filter filter);
const FilterFamily& familyOf(Filter filter);
FilterNeeds needsOf(const FilterSettings& settings);

std::span<const Filter> allFilters();
std::string_view nameOf(Filter filter);
std::string_view titleOf(Filter filter);
std::string_view describe(Filter filter);
Filter filterFromName(std::string_view name); ///< UsageError names the nearest known

} // namespace afterglow
