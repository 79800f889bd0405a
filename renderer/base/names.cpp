// SPDX-License-Identifier: MIT
#include "renderer/base/names.h"

#include "renderer/base/error.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

namespace afterglow {

namespace {

/// Returns the number of letters to insert, delete or replace to make one word of the other
/// (Levenshtein).
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t(0));
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

} // namespace

std::string_view nearestName(std::string_view name, std::span<const std::string_view> known) {
    std::string_view nearest;
    std::size_t least = std::max<std::size_t>(2, name.size() / 3) + 1;
    for (const std::string_view candidate : known)
        if (const std::size_t d = distance(name, candidate); d < least) {
            least = d;
            nearest = candidate;
        }
    return nearest;
}

std::string unknownName(std::string_view kind, std::string_view name,
                        const std::vector<std::string_view>& known) {
    std::string message = "no " + std::string(kind) + " named '" + std::string(name) + "'";
    if (const std::string_view near = nearestName(name, known); !near.empty())
        message += "; did you mean '" + std::string(near) + "'?";
    message += " (known: ";
    for (const std::string_view& one : known)
        message += (&one == known.data() ? "" : ", ") + std::string(one);
    return message + ")";
}

void throwUnknownName(std::string_view kind, std::string_view name,
                      std::span<const std::string_view> known) {
    throw UsageError(unknownName(kind, name, {known.begin(), known.end()}));
}

} // namespace afterglow
