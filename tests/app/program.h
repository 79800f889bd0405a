// SPDX-License-Identifier: MIT
#pragma once

#include "tests/support/temporary_folder.h"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace afterglow::test {

/// What a run of the program left behind.
struct Run {
    int exitCode = -1; ///< 128 + signal if it was killed
    std::string out, err;
};

/// The path in the environment variable AFTERGLOW_BIN; std::runtime_error if it is not set.
std::string programPath();

/// Runs this program with these words and waits for it.
Run afterglow(const std::vector<std::string>& words,
              const std::map<std::string, std::string>& environment = {});

std::string bytesOf(const std::filesystem::path& file);

/// Names of the files below a folder, relative to it, sorted.
std::vector<std::string> filesIn(const std::filesystem::path& folder);

/// Whether a file of a run holds times, so that two runs need not agree on it.
bool tellsTimes(std::string_view file);

/// Exactly one line, which begins with the name of the program.
bool isOneErrorLine(std::string_view text);

} // namespace afterglow::test
