// SPDX-License-Identifier: MIT
#pragma once

#include "app/measure/probe_log.h"

#include <string>

namespace afterglow {

/// All that the log holds as comma-separated values (RFC 4180, but with line ends of "\n"), for
/// other programs to read: one row for every frame, probe and pane that has a sample. Numbers are
/// as short as they can be read back exactly; a field is empty where there is no number. The
/// response is that to the last change of light before or in the frame, as it is known at the end
/// of the log, and only where one is claimed.
std::string toCsv(const ProbeLog& log);

} // namespace afterglow
