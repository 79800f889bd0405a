#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace afterglow {

/// A file that is part of the executable: a shader by its path below shaders/, or a noise table as
/// "noise/<file>".
struct EmbeddedFile {
    std::string_view name, bytes;
};

/// All of them, ordered by name. Written by shaders/embed.cmake.
std::span<const EmbeddedFile> embeddedFiles();

inline std::optional<std::string_view> embeddedFile(std::string_view name) {
    for (const EmbeddedFile& file : embeddedFiles())
        if (file.name == name)
            return file.bytes;
    return std::nullopt;
}

} // namespace afterglow
