// SPDX-License-Identifier: MIT
#include "app/workbench/fields.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <type_traits>

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

bool isDefault(const Settings& settings, const Field& field) {
    return fieldValue(settings, field) == fieldValue(Settings{}, field);
}

void resetField(Settings& settings, const Field& field) {
    setFieldValue(settings, settings, field, fieldValue(Settings{}, field));
}

std::string valueText(const Field& field, double value) {
    if (!field.choices.empty())
        return std::string(field.choices[std::size_t(value)]);
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.4g", value);
    return digits + (field.unit.empty() ? "" : " " + std::string(field.unit));
}

std::vector<const Field*> differingFields(const Settings& a, const Settings& b) {
    std::vector<const Field*> differing;
    for (const Field& field : fields())
        if (fieldValue(a, field) != fieldValue(b, field))
            differing.push_back(&field);
    return differing;
}

} // namespace afterglow
