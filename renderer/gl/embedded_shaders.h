// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/base/embedded_file.h"

#include <optional>
#include <span>
#include <string_view>

namespace afterglow {

/// Returns the shaders, by their paths below shaders/, and the noise tables as "noise/<file>".
std::span<const EmbeddedFile> embeddedFiles();

inline std::optional<std::string_view> embeddedFile(std::string_view name) {
    for (const EmbeddedFile& file : embeddedFiles())
        if (file.name == name)
            return file.bytes;
    return std::nullopt;
}

} // namespace afterglow
