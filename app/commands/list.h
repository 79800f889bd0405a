// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

namespace afterglow {

/// What `afterglow list` can tell of.
std::span<const std::string_view> listKinds();

/// One line each on standard output: name and meaning. UsageError names the nearest known kind.
void runList(std::string_view kind);

} // namespace afterglow
