// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace afterglow {

/// Returns the bytes of a regular file. Throws InputError, naming the file, if it is missing, a
/// folder, something that never ends, larger than `maxBytes`, or cannot be read.
std::string readFile(const std::filesystem::path& path, std::size_t maxBytes = std::size_t(1)
                                                                               << 31);

/// Writes a file as a whole or not at all: a temporary file in the same folder is renamed onto the
/// final name. Throws Error, naming the file and the system's reason, if that fails; nothing is
/// left behind.
void writeFileAtomically(const std::filesystem::path& path, std::string_view bytes);

} // namespace afterglow
