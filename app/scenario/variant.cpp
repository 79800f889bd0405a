// SPDX-License-Identifier: MIT
#include "app/scenario/variant.h"

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
    Settings settings;
    settings.filter = variant.filter;
    settings.lighting.signal = int(signal);
    for (const auto& [key, value] : variant.changes)
        setField(settings, key, value);
    return settings;
}

} // namespace afterglow
