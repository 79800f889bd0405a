// SPDX-License-Identifier: MIT
#include "app/base/json_reader.h"

#include "renderer/base/error.h"
#include "renderer/base/json.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>

#include <nlohmann/json.hpp>

namespace afterglow {
namespace {

/// A number as short as it can be said: "0.001", "1000".
std::string shown(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

std::string shown(const nlohmann::json& value) {
    constexpr std::size_t kMost = 40;
    if (value.is_object())
        return value.empty() ? "an empty object" : "an object";
    if (value.is_array())
        return "a list of " + std::to_string(value.size());
    // Bytes that are not UTF-8 are replaced, and a long text is cut.
    std::string text = asciiJsonText(value);
    return text.size() > kMost ? text.substr(0, kMost) + "..." : text;
}

std::string quotedList(std::span<const std::string_view> names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        text += i == 0 ? "\"" : i + 1 == names.size() ? " or \"" : ", \"";
        text += std::string(names[i]) + "\"";
    }
    return text;
}

} // namespace

void JsonReader::refuse(const std::string& cause) const {
    throw InputError(std::string(source_) + ": " + (path_.empty() ? "" : path_ + ": ") + cause);
}

void JsonReader::fail(std::string_view wanted) const {
    refuse("expected " + std::string(wanted) + ", found " + shown(*value_));
}

void JsonReader::expectKeys(std::initializer_list<std::string_view> known) const {
    if (!value_->is_object())
        fail("an object");
    for (const auto& [key, value] : value_->items()) {
        if (std::find(known.begin(), known.end(), key) == known.end())
            refuse("unknown key " + shown(nlohmann::json(key)) + "; known are " +
                   quotedList({known.begin(), known.size()}));
    }
}

std::optional<JsonReader> JsonReader::find(std::string_view key) const {
    if (!value_->is_object())
        fail("an object");
    const auto found = value_->find(std::string(key));
    if (found == value_->end())
        return std::nullopt;
    return JsonReader(*found, source_, (path_.empty() ? "" : path_ + ".") + std::string(key));
}

JsonReader JsonReader::at(std::string_view key) const {
    const std::optional<JsonReader> member = find(key);
    if (!member)
        refuse("\"" + std::string(key) + "\" is missing");
    return *member;
}

std::vector<JsonReader> JsonReader::list(std::string_view wanted, std::size_t least,
                                         std::size_t most) const {
    if (!value_->is_array() || value_->size() < least || value_->size() > most)
        fail(wanted);
    std::vector<JsonReader> items;
    for (std::size_t i = 0; i < value_->size(); ++i)
        items.push_back(JsonReader((*value_)[i], source_, path_ + "[" + std::to_string(i) + "]"));
    return items;
}

std::vector<std::pair<std::string, JsonReader>> JsonReader::members() const {
    if (!value_->is_object())
        fail("an object");
    std::vector<std::pair<std::string, JsonReader>> members;
    for (const auto& item : value_->items())
        members.emplace_back(item.key(), at(item.key()));
    return members;
}

bool JsonReader::isText() const {
    return value_->is_string();
}

std::string JsonReader::setting() const {
    if (isText())
        return text();
    if (!value_->is_number())
        fail("a number or a name");
    std::array<char, 40> digits{};
    const auto end =
        std::to_chars(digits.data(), digits.data() + digits.size(), value_->get<double>()).ptr;
    return {digits.data(), end};
}

bool JsonReader::boolean() const {
    if (!value_->is_boolean())
        fail("true or false");
    return value_->get<bool>();
}

double JsonReader::number(double least, double most) const {
    const double value = value_->is_number() ? value_->get<double>() : std::nan("");
    if (!(value >= least && value <= most))
        fail("a number from " + shown(least) + " to " + shown(most));
    return value;
}

std::int64_t JsonReader::wholeNumber(std::int64_t least, std::int64_t most) const {
    // Above this the bound is only what fits, and naming it would not help.
    constexpr std::int64_t kOpen = 1ll << 30;
    // 1e3 is a whole number, too. Beyond 2^53 a double cannot tell, and nothing here goes that far.
    const double value = value_->is_number() ? value_->get<double>() : std::nan("");
    if (!(value >= double(least) && value <= double(most) && value == std::floor(value)))
        fail(most > kOpen
                 ? "a whole number >= " + std::to_string(least)
                 : "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    return std::int64_t(value);
}

std::string JsonReader::text() const {
    if (!value_->is_string())
        fail("a text");
    return value_->get<std::string>();
}

std::size_t JsonReader::choice(std::span<const std::string_view> names) const {
    const auto found = value_->is_string()
                           ? std::find(names.begin(), names.end(), value_->get<std::string>())
                           : names.end();
    if (found == names.end())
        fail(quotedList(names));
    return std::size_t(found - names.begin());
}

double shortest(float value) {
    std::array<char, 40> text{};
    std::to_chars(text.data(), text.data() + text.size(), value);
    return std::strtod(text.data(), nullptr);
}

JsonDocument::JsonDocument(std::string_view text, std::string_view source) : source_(source) {
    using Event = nlohmann::json::parse_event_t;
    // The library keeps the last of two equal keys, which would hide a mistake.
    std::vector<std::set<std::string>> keys;
    const auto watch = [&](int, Event event, nlohmann::json& value) {
        if (event == Event::object_start)
            keys.emplace_back();
        else if (event == Event::object_end)
            keys.pop_back();
        else if (event == Event::key && !keys.back().insert(value.get<std::string>()).second)
            throw InputError(source_ + ": the key " + shown(value) + " occurs twice");
        return true;
    };
    try {
        value_ = std::make_unique<nlohmann::json>(
            nlohmann::json::parse(text.begin(), text.end(), watch));
    } catch (const nlohmann::json::parse_error& error) {
        const auto end = text.begin() + std::ptrdiff_t(std::min(error.byte, text.size()));
        throw InputError(source_ + ":" + std::to_string(1 + std::count(text.begin(), end, '\n')) +
                         ": this is not JSON");
    } catch (const nlohmann::json::exception&) {
        // The other complaint that parsing has.
        throw InputError(source_ + ": a number is too large");
    }
}

JsonDocument::~JsonDocument() = default;

JsonReader JsonDocument::root() const {
    return JsonReader(*value_, source_, "");
}

} // namespace afterglow
