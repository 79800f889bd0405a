// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace afterglow {

// The parser and the writer of nlohmann::json take long to compile. Only json.cpp does; other files
// call these. All that is read and written is UTF-8.

/// Parses a document whose members keep their order. Throws nlohmann::json::exception.
nlohmann::ordered_json parseJson(std::string_view text);
/// Parses a document whose members are in the order of the alphabet. Throws the same.
nlohmann::json parseSortedJson(std::string_view text);

/// Returns the text of a document: with `indent` spaces a level, or in one line if that is
/// negative. Bytes that are not UTF-8 become U+FFFD.
std::string jsonText(const nlohmann::ordered_json& json, int indent = -1);
std::string jsonText(const nlohmann::json& json, int indent = -1);
/// Does the same with every character beyond ASCII as its escape.
std::string asciiJsonText(const nlohmann::json& json);

} // namespace afterglow
