// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/pipeline/settings.h"

#include <string>
#include <vector>

namespace afterglow {

// The tunables of the table fields(), as numbers: the index of an enumeration, or the value.

/// std::logic_error for a key that is not in the table.
const Field& fieldByKey(std::string_view key);
double fieldValue(const Settings& settings, const Field& field);
/// Clamped to its range.
void setFieldValue(FrameSettings& frame, FilterSettings& filter, const Field& field, double value);
double defaultValue(const Settings& settings, const Field& field); ///< that of its filter
bool isDefault(const Settings& settings, const Field& field);

/// "0.2", "128", "power".
std::string valueText(const Field& field, double value);

/// "filter=svgf alpha=0.1": the filter, and what is not at its default, as setField() takes it. The
/// display is left out: it changes no measured number.
std::string settingsText(const Settings& settings);

/// Those whose values differ, in the order of the table. The filter is not among them.
std::vector<const Field*> differingFields(const Settings& a, const Settings& b);

} // namespace afterglow
