// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace afterglow {

/// One value of a JSON document that knows where it stands. Every mismatch is an InputError:
/// "file: path: expected this, found that". It must not outlive its document.
class JsonReader {
public:
    /// The name of the document, with which every message begins.
    std::string_view source() const { return source_; }

    /// Throws "expected <wanted>, found <this value>".
    [[noreturn]] void fail(std::string_view wanted) const;
    /// Throws the cause.
    [[noreturn]] void refuse(const std::string& cause) const;

    /// Each key of this object must be one of these.
    void expectKeys(std::initializer_list<std::string_view> known) const;

    /// A member of this object that must be there, and one that need not be.
    JsonReader at(std::string_view key) const;
    std::optional<JsonReader> find(std::string_view key) const;

    /// The items of this list; `wanted` describes it.
    std::vector<JsonReader> list(std::string_view wanted, std::size_t least,
                                 std::size_t most) const;

    /// The members of this object, in the order of the alphabet.
    std::vector<std::pair<std::string, JsonReader>> members() const;

    /// A list of as many numbers as the vector has; `wanted` describes it.
    template <class Vector>
    Vector vector(std::string_view wanted, double least, double most) const {
        constexpr std::size_t kCount = Vector::length();
        const std::vector<JsonReader> items = list(wanted, kCount, kCount);
        Vector result;
        for (std::size_t i = 0; i < kCount; ++i)
            if constexpr (std::is_integral_v<typename Vector::value_type>)
                result[int(i)] = int(items[i].wholeNumber(std::int64_t(least), std::int64_t(most)));
            else
                result[int(i)] = float(items[i].number(least, most));
        return result;
    }

    bool isText() const;
    /// What can be said of a setting: a number, or the name of one of its values, as text for
    /// setField().
    std::string setting() const;
    bool boolean() const;
    double number(double least, double most) const; ///< the bounds belong to the range
    std::int64_t wholeNumber(std::int64_t least, std::int64_t most) const; ///< likewise
    std::string text() const;
    std::size_t
    choice(std::span<const std::string_view> names) const; ///< its index among the names

private:
    friend class JsonDocument;
    JsonReader(const nlohmann::json& value, std::string_view source, std::string path)
        : value_(&value), source_(source), path_(std::move(path)) {}

    const nlohmann::json* value_;
    std::string_view source_;
    std::string path_; ///< "timeline[0].frame"; empty for the whole document
};

/// Sets a value to what `read` makes of a member, where that is there.
template <class Value, class Read>
void readIfThere(const JsonReader& json, std::string_view key, Value& value, Read read) {
    if (const auto member = json.find(key))
        value = Value(std::invoke(read, *member));
}

/// Returns the double that is written as shortly as the float: 0.1, not 0.10000000149.
double shortest(float value);

/// A parsed file. Text that is not JSON, or has a key twice, is an InputError with the line.
class JsonDocument {
public:
    JsonDocument(std::string_view text, std::string_view source);
    ~JsonDocument();

    JsonReader root() const;

private:
    std::unique_ptr<nlohmann::json> value_;
    std::string source_;
};

} // namespace afterglow
