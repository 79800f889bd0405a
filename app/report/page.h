#pragma once

#include "app/report/picture_store.h"

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace afterglow {

/// The files of assets/report, linked into the program.
struct ReportAssets {
    std::string_view html, style, script; ///< the scripts in one piece
};
ReportAssets reportAssets();

/// The page: the document with its style and script, `data` as JSON for the script to read, and the
/// pictures. Whatever the texts in `data` and the title hold, they stay texts.
std::string reportPage(std::string_view title, const nlohmann::ordered_json& data,
                       const PictureStore& pictures);

} // namespace afterglow
