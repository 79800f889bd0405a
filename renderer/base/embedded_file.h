// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace afterglow {

/// A file that is linked into the program; cmake/embed.cmake writes tables of them.
struct EmbeddedFile {
    std::string_view name; ///< its path below the folder that is embedded
    std::string_view bytes;
};

} // namespace afterglow
