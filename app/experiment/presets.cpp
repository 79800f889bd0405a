#include "app/experiment/presets.h"

#include "app/experiment/embedded.h"
#include "app/experiment/json_reader.h"
#include "renderer/base/error.h"

#include <algorithm>

namespace afterglow {

Preset parsePreset(std::string_view text, std::string_view source) {
    const JsonDocument document(text, source);
    const JsonReader json = document.root();
    json.expectKeys({"name", "description", "source", "filter", "settings"});
    Preset preset;
    preset.name = json.at("name").text();
    preset.description = json.at("description").text();
    preset.source = json.at("source").text();
    std::vector<std::string_view> filters;
    for (const Filter filter : allFilters())
        filters.push_back(nameOf(filter));
    if (preset.name.empty() || std::ranges::find(filters, preset.name) != filters.end())
        json.at("name").fail("a name that is no filter's");
    preset.variant = {.name = preset.name,
                      .filter = allFilters()[json.at("filter").choice(filters)]};
    for (const auto& [key, value] : json.at("settings").members())
        preset.variant.changes.emplace_back(key, value.setting());
    try {
        settingsOf(preset.variant, Signal::Both);
    } catch (const UsageError& error) {
        throw InputError(std::string(source) + ": settings: " + error.what());
    }
    return preset;
}

std::span<const Preset> presets() {
    static const std::vector<Preset> all = [] {
        std::vector<Preset> parsed;
        for (const EmbeddedFile& file : embeddedPresets())
            parsed.push_back(parsePreset(file.text, std::string(file.name) + ".json"));
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

} // namespace afterglow
