// SPDX-License-Identifier: MIT
#include "app/scenario/presets.h"

#include "app/base/embedded.h"
#include "app/base/json_reader.h"
#include "renderer/base/error.h"
#include "renderer/base/json.h"

#include <algorithm>
#include <array>
#include <charconv>

#include <nlohmann/json.hpp>

namespace afterglow {

namespace {

constexpr std::size_t kNameLength = 64;

std::vector<std::string_view> filterNames() {
    std::vector<std::string_view> names;
    for (const Filter filter : allFilters())
        names.push_back(nameOf(filter));
    return names;
}

bool isFilterName(std::string_view name) {
    return std::ranges::count(filterNames(), name) > 0;
}

/// Counts the bytes of UTF-8 that do not continue a character.
std::size_t characters(std::string_view text) {
    return std::size_t(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

/// Returns a field's value as setField() takes it: the shortest that is this very number.
std::string valueText(const Settings& settings, const Field& field) {
    Settings copy = settings;
    const Field::Ref ref = field.in(copy);
    std::array<char, 40> digits{};
    char* const last = digits.data() + digits.size();
    if (const float* const* number = std::get_if<float*>(&ref))
        return {digits.data(), std::to_chars(digits.data(), last, **number).ptr};
    const int value = *std::get<int*>(ref);
    if (!field.choices.empty())
        return std::string(field.choices[std::size_t(value)]);
    return {digits.data(), std::to_chars(digits.data(), last, value).ptr};
}

const Field* fieldNamed(std::string_view key) {
    const auto found = std::ranges::find(fields(), key, &Field::key);
    return found == fields().end() ? nullptr : &*found;
}

std::string readTitle(const JsonReader& json, const std::string& name) {
    const std::optional<JsonReader> title = json.find("title");
    if (!title)
        return name;
    if (characters(title->text()) > kTitleLength)
        title->fail("at most " + std::to_string(kTitleLength) + " characters");
    return title->text();
}

} // namespace

bool isPresetName(std::string_view name) {
    const auto isPlain = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '-' || c == '_';
    };
    return !name.empty() && name.size() <= kNameLength && std::ranges::all_of(name, isPlain) &&
           !isFilterName(name);
}

Preset parsePreset(std::string_view text, std::string_view source) {
    const JsonDocument document(text, source);
    const JsonReader json = document.root();
    json.expectKeys({"name", "title", "description", "source", "filter", "settings"});
    Preset preset;
    preset.name = json.at("name").text();
    if (preset.name.empty() || isFilterName(preset.name))
        json.at("name").fail("a name that is no filter's");
    if (!isPresetName(preset.name))
        json.at("name").fail("at most " + std::to_string(kNameLength) +
                             " letters, digits, \"-\" and \"_\"");
    preset.title = readTitle(json, preset.name);
    preset.description = json.at("description").text();
    preset.source = json.at("source").text();
    preset.variant = {.name = preset.name,
                      .filter = allFilters()[json.at("filter").choice(filterNames())]};
    for (const auto& [key, value] : json.at("settings").members()) {
        if (const Field* field = fieldNamed(key); field && field->isFrameWide())
            value.refuse("belongs to the whole frame, not to a filter");
        preset.variant.changes.emplace_back(key, value.setting());
    }
    try {
        settingsOf(preset.variant, Signal::Both);
    } catch (const UsageError& error) {
        throw InputError(std::string(source) + ": settings: " + error.what());
    }
    return preset;
}

std::string presetText(const Preset& preset) {
    using Json = nlohmann::ordered_json;
    const Settings settings = settingsOf(preset.variant, Signal::Both);
    Json changes = Json::object();
    for (const SettingDifference& change :
         differencesOf(defaultSettings(settings.filter), settings)) {
        const Field& field = *fieldNamed(change.key);
        if (field.choices.empty())
            changes[change.key] = parseJson(change.valueB);
        else
            changes[change.key] = change.valueB;
    }
    Json json;
    json["name"] = preset.name;
    if (!preset.title.empty() && preset.title != preset.name)
        json["title"] = preset.title;
    json["description"] = preset.description;
    json["source"] = preset.source;
    json["filter"] = nameOf(settings.filter);
    json["settings"] = changes;
    return jsonText(json, 4) + "\n";
}

Preset presetOf(std::string_view name, const Settings& settings) {
    Preset preset{.name = std::string(name)};
    preset.variant = {.name = preset.name, .filter = settings.filter};
    for (SettingDifference& change : differencesOf(defaultSettings(settings.filter), settings))
        preset.variant.changes.emplace_back(std::move(change.key), std::move(change.valueB));
    return preset;
}

std::span<const Preset> presets() {
    static const std::vector<Preset> all = [] {
        std::vector<Preset> parsed;
        for (const EmbeddedFile& file : embeddedPresets())
            parsed.push_back(parsePreset(file.bytes, file.name));
        return parsed;
    }();
    return all;
}

Variant variantNamed(std::string_view name) {
    std::vector<std::string_view> known;
    for (const Filter filter : allFilters()) {
        if (nameOf(filter) == name)
            return variantOf(filter);
        known.push_back(nameOf(filter));
    }
    for (const Preset& preset : presets()) {
        if (preset.name == name)
            return preset.variant;
        known.push_back(preset.name);
    }
    throwUnknownName("filter", name, known);
}

std::vector<SettingDifference> differencesOf(const Settings& a, const Settings& b) {
    std::vector<SettingDifference> differences;
    if (a.filter != b.filter)
        differences.push_back(
            {"Filter", "filter", std::string(nameOf(a.filter)), std::string(nameOf(b.filter))});
    for (const Field& field : fields()) {
        if (field.isFrameWide())
            continue;
        const std::string valueA = valueText(a, field), valueB = valueText(b, field);
        if (valueA != valueB)
            differences.push_back(
                {std::string(field.label), std::string(field.key), valueA, valueB});
    }
    return differences;
}

} // namespace afterglow
