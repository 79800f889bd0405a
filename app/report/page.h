#pragma once

#include "app/report/picture_store.h"

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace afterglow {

/// The page: the document with its style and script, `data` as JSON for the script to read, and the
/// pictures. Whatever the texts in `data` and the title hold, they stay texts.
std::string reportPage(std::string_view title, const nlohmann::ordered_json& data,
                       const PictureStore& pictures);

} // namespace afterglow
