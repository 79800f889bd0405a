// SPDX-License-Identifier: MIT
#pragma once

#include "app/scenario/presets.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace afterglow {

/// The presets that come with the program and those of the user, each of these a file NAME.json in
/// one folder.
class PresetStore {
public:
    struct Entry {
        Preset preset = {}; ///< of a broken file only its name
        bool builtIn = false;
        std::string error = {}; ///< why the file is none, with its path; empty: it is one
    };

    /// Reads the user's, from a folder that need not be there.
    explicit PresetStore(std::filesystem::path folder);

    /// The built-in ones first, then the user's, each in alphabetical order.
    std::span<const Entry> list() const { return entries_; }
    /// Null without a whole preset of this name.
    const Preset* find(std::string_view name) const;
    const std::filesystem::path& folder() const { return folder_; }

    /// Reads the user's again.
    void reload();

    /// Writes the user's preset of this name, whole or not at all, over one that was there.
    /// UsageError for a name that is none (isPresetName) or that of a built-in one, InputError for
    /// a title that is too long, Error if the file cannot be written.
    void save(const Preset& preset);

    /// Removes the user's file of this name, also a broken one. UsageError if there is none, or if
    /// the preset is built in; Error if the file cannot be removed.
    void remove(std::string_view name);

private:
    std::filesystem::path fileOf(std::string_view name) const;

    std::filesystem::path folder_;
    std::vector<Entry> entries_;
};

} // namespace afterglow
