// SPDX-License-Identifier: MIT
#pragma once

#include "app/scenario/variant.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace afterglow {

/// A filter with settings that somebody has published, or that was chosen by measurement: a file of
/// assets/presets, or one that a user has saved.
struct Preset {
    std::string name = {};        ///< unique, and no filter's name; see isPresetName()
    std::string title = {};       ///< for a person, at most kTitleLength characters
    std::string description = {}; ///< one line
    std::string source = {};      ///< where its values come from
    Variant variant = {};         ///< under the preset's name
};

constexpr std::size_t kTitleLength = 24;

/// Returns whether a text may name a preset, and so its file: letters, digits, "-" and "_", at most
/// 64, and no filter's name.
bool isPresetName(std::string_view name);

/// Reads a preset from the text of its file; InputError as parseExperiment(). A file without
/// "title" has its name for one. Settings of lighting and display are refused: they belong to the
/// whole frame.
Preset parsePreset(std::string_view text, std::string_view source);

/// Returns the file of a preset: of its settings those that are not at their default.
std::string presetText(const Preset& preset);

/// Returns the preset that makes these settings a filter, without lighting and display. Title,
/// description and source are empty.
Preset presetOf(std::string_view name, const Settings& settings);

/// Returns the presets that come with the program, in alphabetical order.
std::span<const Preset> presets();

/// Returns the filter or preset of this name; UsageError names the nearest known.
Variant variantNamed(std::string_view name);

/// One setting in which two filters differ. The values are as setField() takes them.
struct SettingDifference {
    std::string label; ///< for a person
    std::string key;   ///< of the field, or "filter"
    std::string valueA, valueB;

    bool operator==(const SettingDifference&) const = default;
};

/// Returns the settings in which two filters differ: the filter, then the fields of the denoiser in
/// their order. Lighting and display are left out.
std::vector<SettingDifference> differencesOf(const Settings& a, const Settings& b);

} // namespace afterglow
