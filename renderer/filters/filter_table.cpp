// SPDX-License-Identifier: MIT
#include "renderer/filters/filter_table.h"

#include "renderer/base/names.h"
#include "renderer/filters/svgf_filter.h"

#include <array>
#include <vector>

namespace afterglow {

std::span<const FilterInfo> filterTable() {
    static const std::array rows{
        FilterInfo{Filter::None, "none", "None",
                   "the raw signal: one sample per pixel, nothing filtered", svgfFamily()},
        FilterInfo{Filter::Fixed, "fixed", "Fixed \xce\xb1",
                   "temporal accumulation with a fixed alpha, no spatial filter", svgfFamily()},
        FilterInfo{Filter::Svgf, "svgf", "SVGF",
                   "SVGF: temporal accumulation and a spatial filter guided by variance (Schied et "
                   "al. 2017)",
                   svgfFamily()},
        FilterInfo{Filter::Asvgf, "asvgf", "A-SVGF",
                   "A-SVGF: SVGF with an alpha per pixel from temporal gradients (Schied et al. "
                   "2018)",
                   svgfFamily()},
        FilterInfo{Filter::Clamp, "clamp", "Clamp",
                   "SVGF whose history is clamped to the raw signal around (Karis 2014, Salvi "
                   "2016)",
                   svgfFamily()},
        FilterInfo{Filter::Percentile, "percentile", "Percentile",
                   "SVGF with an alpha per pixel from percentiles of the raw luminance (after "
                   "merian)",
                   svgfFamily()},
        FilterInfo{Filter::Confidence, "confidence", "Confidence",
                   "A-SVGF whose gradients cut the history length (after history confidence in "
                   "NRD)",
                   svgfFamily()},
        FilterInfo{
            Filter::Counted, "counted", "Counted",
            "a history that is a mean of samples, from which each change of light takes some "
            "away",
            svgfFamily()},
    };
    return rows;
}

const FilterInfo& infoOf(Filter filter) {
    return filterTable()[std::size_t(filter)];
}
const FilterFamily& familyOf(Filter filter) {
    return infoOf(filter).family;
}
FilterNeeds needsOf(const FilterSettings& settings) {
    return familyOf(settings.filter).needs(settings);
}

std::span<const Filter> allFilters() {
    static const std::vector<Filter> all = [] {
        std::vector<Filter> filters;
        for (const FilterInfo& row : filterTable())
            filters.push_back(row.filter);
        return filters;
    }();
    return all;
}

std::string_view nameOf(Filter filter) {
    return infoOf(filter).name;
}
std::string_view titleOf(Filter filter) {
    return infoOf(filter).title;
}
std::string_view describe(Filter filter) {
    return infoOf(filter).sentence;
}

Filter filterFromName(std::string_view name) {
    std::vector<std::string_view> known;
    for (const FilterInfo& row : filterTable()) {
        if (row.name == name)
            return row.filter;
        known.push_back(row.name);
    }
    throwUnknownName("filter", name, known);
}

} // namespace afterglow
