// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/pipeline/settings.h"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace afterglow {

/// The place of a variant in a sweep of one setting.
struct SweepPoint {
    std::string variant; ///< the one that it was made from
    std::string key;     ///< of the setting
    std::string value;   ///< as setField() takes it

    bool operator==(const SweepPoint&) const = default;
};

/// A filter with settings of its own. In a file either a filter's name, which is then the
/// variant's, or {"name": ..., "filter": ..., "settings": {...}}. What another program has made of
/// exported frames is {"name": ..., "filter": "external"}: it has no settings here.
struct Variant {
    std::string name; ///< letters, digits, "-", "_" and ".": names a folder
    Filter filter = Filter::Asvgf;
    /// Keys and values for setField(), in their order; all else has its default.
    std::vector<std::pair<std::string, std::string>> changes = {};
    std::optional<SweepPoint> sweep = {};
    bool external = false; ///< made by another program; `filter` is then None

    bool operator==(const Variant&) const = default;
};

/// Returns a filter with everything at its default, under the filter's name.
Variant variantOf(Filter filter);

/// Returns whether a text may name a variant or an experiment: letters, digits, "-", "_" and ".",
/// which is not the first.
bool isPlainName(std::string_view name);

/// UsageError for a setting that does not exist or a value out of range.
Settings settingsOf(const Variant& variant, Signal signal);

/// Throws UsageError where pictures with these settings cannot be held against a reference.
void requireMeasurable(const Settings& settings);

} // namespace afterglow
