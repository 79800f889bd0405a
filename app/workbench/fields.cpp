// SPDX-License-Identifier: MIT
#include "app/workbench/fields.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <type_traits>

#include <fmt/format.h>

namespace afterglow {

const Field& fieldByKey(std::string_view key) {
    const auto field = std::ranges::find(fields(), key, &Field::key);
    if (field == fields().end())
        throw std::logic_error("no field with the key " + std::string(key));
    return *field;
}

double fieldValue(const Settings& settings, const Field& field) {
    Settings copy = settings; // the table gives references to what may be changed
    return std::visit([](auto* value) { return double(*value); }, field.in(copy));
}

void setFieldValue(FrameSettings& frame, FilterSettings& filter, const Field& field, double value) {
    const double allowed = std::clamp(value, field.min, field.max);
    std::visit(
        [allowed](auto* member) {
            using Member = std::remove_pointer_t<decltype(member)>;
            *member = std::is_integral_v<Member> ? Member(std::lround(allowed)) : Member(allowed);
        },
        field.in(frame, filter));
}

double defaultValue(const Settings& settings, const Field& field) {
    return fieldValue(defaultSettings(settings.filter), field);
}

bool isDefault(const Settings& settings, const Field& field) {
    return fieldValue(settings, field) == defaultValue(settings, field);
}

std::string valueText(const Field& field, double value) {
    if (!field.choices.empty())
        return std::string(field.choices[std::size_t(value)]);
    return fmt::format("{:.4g}{}{}", value, field.unit.empty() ? "" : " ", field.unit);
}

std::string settingsText(const Settings& settings) {
    std::string text = fmt::format("filter={}", nameOf(settings.filter));
    for (const Field* field : differingFields(settings, defaultSettings(settings.filter))) {
        if (field->group == "display")
            continue;
        const double value = fieldValue(settings, *field);
        // As a float, so that 0.1f is written as 0.1.
        text += field->choices.empty()
                    ? fmt::format(" {}={}", field->key, float(value))
                    : fmt::format(" {}={}", field->key, field->choices[std::size_t(value)]);
    }
    return text;
}

std::vector<const Field*> differingFields(const Settings& a, const Settings& b) {
    std::vector<const Field*> differing;
    for (const Field& field : fields())
        if (fieldValue(a, field) != fieldValue(b, field))
            differing.push_back(&field);
    return differing;
}

} // namespace afterglow
