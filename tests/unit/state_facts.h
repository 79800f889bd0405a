// SPDX-License-Identifier: MIT
#pragma once

#include "app/workbench/view_state.h"

#include <map>
#include <string>
#include <vector>

namespace afterglow {

/// All that a ViewState says, each thing by name: two states differ in what differs here.
using Facts = std::map<std::string, std::string>;
Facts factsOf(const ViewState& state);

/// "name=value" of `after` for what is not as in `before`, in the order of names.
std::vector<std::string> differences(const Facts& before, const Facts& after);

} // namespace afterglow
