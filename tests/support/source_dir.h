// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace afterglow {

/// Returns the root of the checkout that the tests were built from.
std::filesystem::path sourceDir();

} // namespace afterglow
