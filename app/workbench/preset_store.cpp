// SPDX-License-Identifier: MIT
#include "app/workbench/preset_store.h"

#include "app/base/output.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"

#include <algorithm>

namespace afterglow {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxBytes = 1 << 20;

bool isBuiltIn(std::string_view name) {
    return std::ranges::count(presets(), name, &Preset::name) > 0;
}

Preset readPreset(const fs::path& file) {
    Preset preset = parsePreset(readFile(file, kMaxBytes), file.string());
    if (preset.name != file.stem().string())
        throw InputError(file.string() + ": name: expected \"" + file.stem().string() +
                         "\", as the file is named, found \"" + preset.name + "\"");
    if (isBuiltIn(preset.name))
        throw InputError(file.string() + ": a preset of this name comes with the program");
    return preset;
}

} // namespace

PresetStore::PresetStore(fs::path folder) : folder_(std::move(folder)) {
    reload();
}

void PresetStore::reload() {
    entries_.clear();
    std::error_code error;
    for (fs::directory_iterator i(folder_, error), end; !error && i != end; i.increment(error)) {
        const fs::path file = i->path();
        if (file.extension() != ".json" || file.filename().string().starts_with('.'))
            continue;
        Entry entry{.preset = {.name = file.stem().string()}};
        try {
            entry.preset = readPreset(file);
        } catch (const InputError& cause) {
            entry.error = cause.what();
        }
        entries_.push_back(std::move(entry));
    }
    if (error && error != std::errc::no_such_file_or_directory)
        entries_.push_back({{.name = folder_.filename().string()},
                            false,
                            folder_.string() + ": cannot be read: " + error.message()});
    std::ranges::sort(entries_, {}, [](const Entry& entry) { return entry.preset.name; });

    std::vector<Entry> builtIn;
    for (const Preset& preset : presets())
        builtIn.push_back({preset, true, {}});
    entries_.insert(entries_.begin(), builtIn.begin(), builtIn.end());
}

const Preset* PresetStore::find(std::string_view name) const {
    for (const Entry& entry : entries_)
        if (entry.error.empty() && entry.preset.name == name)
            return &entry.preset;
    return nullptr;
}

void PresetStore::save(const Preset& preset) {
    if (!isPresetName(preset.name))
        throw UsageError("a preset's name is made of letters, digits, '-' and '_' and is no "
                         "filter's, not '" +
                         preset.name + "'");
    if (isBuiltIn(preset.name))
        throw UsageError("the preset '" + preset.name +
                         "' comes with the program; save under another name");
    const fs::path file = fileOf(preset.name);
    const std::string text = presetText(preset);
    parsePreset(text, file.string()); // what is saved can be read

    OutputFolder(folder_).writeText(file.filename().string(), text);
    reload();
}

void PresetStore::remove(std::string_view name) {
    const auto found = std::ranges::find_if(
        entries_, [&](const Entry& entry) { return !entry.builtIn && entry.preset.name == name; });
    const fs::path file = fileOf(name);
    if (found == entries_.end() && isBuiltIn(name))
        throw UsageError("the preset '" + std::string(name) + "' comes with the program and stays");
    if (found == entries_.end())
        throw UsageError("there is no preset '" + std::string(name) + "' in " + folder_.string());
    std::error_code error;
    fs::remove(file, error);
    if (error)
        throw Error(file.string() + ": cannot be removed: " + error.message());
    reload();
}

fs::path PresetStore::fileOf(std::string_view name) const {
    return folder_ / (std::string(name) + ".json");
}

} // namespace afterglow
