// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace afterglow {

/// The root of the checkout that the tests were built from.
std::filesystem::path sourceDir();

} // namespace afterglow
