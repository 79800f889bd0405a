// SPDX-License-Identifier: MIT
#include "renderer/base/json.h"

#include <nlohmann/json.hpp>

namespace afterglow {

namespace {

template <class Json>
std::string textOf(const Json& json, int indent, bool ascii) {
    return json.dump(indent, ' ', ascii, Json::error_handler_t::replace);
}

} // namespace

nlohmann::ordered_json parseJson(std::string_view text) {
    return nlohmann::ordered_json::parse(text.begin(), text.end());
}

nlohmann::json parseSortedJson(std::string_view text) {
    return nlohmann::json::parse(text.begin(), text.end());
}

std::string jsonText(const nlohmann::ordered_json& json, int indent) {
    return textOf(json, indent, false);
}

std::string jsonText(const nlohmann::json& json, int indent) {
    return textOf(json, indent, false);
}

std::string asciiJsonText(const nlohmann::json& json) {
    return textOf(json, -1, true);
}

} // namespace afterglow
