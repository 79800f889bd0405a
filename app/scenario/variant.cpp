// SPDX-License-Identifier: MIT
#include "app/scenario/variant.h"

#include "renderer/base/error.h"

#include <algorithm>

namespace afterglow {

Variant variantOf(Filter filter) {
    return {.name = std::string(nameOf(filter)), .filter = filter};
}

bool isPlainName(std::string_view name) {
    const auto isPlain = [](unsigned char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '-' || c == '_' || c == '.';
    };
    return !name.empty() && name[0] != '.' && std::ranges::all_of(name, isPlain);
}

Settings settingsOf(const Variant& variant, Signal signal) {
    Settings settings = defaultSettings(variant.filter);
    settings.lighting.signal = int(signal);
    for (const auto& [key, value] : variant.changes)
        setField(settings, key, value);
    return settings;
}

void requireMeasurable(const Settings& settings) {
    if (AntiAliasing(settings.display.antiAliasing) != AntiAliasing::Off)
        throw UsageError("an experiment measures at the centers of pixels, where its references "
                         "are: antiAliasing stays off");
    if (settings.display.autoExposure != 0)
        throw UsageError("an experiment measures all of its pictures at one exposure: autoExposure "
                         "stays off");
}

} // namespace afterglow
