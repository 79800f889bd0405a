// SPDX-License-Identifier: MIT
#pragma once

#include "app/measure/probe_log.h"

#include <string>

namespace afterglow {

/// The conditions under which a log was measured; they are the same for all of its frames.
struct ProbeRun {
    std::string scene; ///< a scene or an experiment, as it was asked for
    std::uint32_t seed = 0;
    glm::ivec2 size{0}; ///< of the rendered picture, in pixels
};

/// Returns the log as text for other programs. First one fact a line after "# ": the run,
/// the settings of each pane from the frame on in which they began, the events, and how each pane
/// answered each of them at each probe. Then comma-separated values (RFC 4180, but with line ends
/// of "\n"): one row for every frame, probe and pane that has a sample. Numbers are as short as
/// they can be read back exactly; a field is empty where there is no number. The response is that
/// to the last change of light before or in the frame, as it is known at the end of the log, and
/// only where one is claimed.
std::string toCsv(const ProbeLog& log, const ProbeRun& run);

} // namespace afterglow
