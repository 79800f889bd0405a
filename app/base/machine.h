// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace afterglow {

/// The commit that this program was built from, "+" behind it if the source had changes; "unknown"
/// if it was not built from a repository.
std::string_view commit();

/// What this program and its shaders are, so that two that may differ in any bit of a picture do
/// not have the same: a hash of the executable file.
std::string programFingerprint();

/// {cpu, threads, os}
nlohmann::ordered_json describeMachine();

} // namespace afterglow
