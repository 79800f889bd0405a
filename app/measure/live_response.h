// SPDX-License-Identifier: MIT
#pragma once

#include "app/measure/probe_log.h"

#include <optional>
#include <string>
#include <vector>

namespace afterglow {

/// How a pane answers a change of light at a probe, measured while it happens and without a
/// reference. docs/experiments.md defines the same numbers over a picture.
struct LiveResponse {
    enum class Status {
        Waiting,     ///< no change of light, or too little is known of the light around it
        NotMeasured, ///< and no more will be known; or it is of another filter or other settings
        TooSmall,    ///< the step is below 2 %
        TooNoisy,    ///< the step is not told from the noise of the probe
        Live,        ///< against the mean of the noisy signal since the event, which has no bias
        Settled      ///< against the level that the pane came to: its bias is not taken for lag
    };
    Status status = Status::Waiting;
    std::string event;        ///< "key off"; empty: none
    double before = 0.0;      ///< mean luminance, of up to 16 frames before the event
    double target = 0.0;      ///< mean luminance
    double targetError = 0.0; ///< standard error of it
    int framesSince = 0;      ///< measured after the event's own frame
    bool over = false;        ///< something else happened, or the pane stopped: no more will come
    bool isOnePixel = false;  ///< the probe

    // Only where Live or Settled.
    std::vector<double> p;       ///< 0: the old light, 1: the new; p[0] is the event's own frame
    std::optional<int> t50, t90; ///< frames; empty: not yet, or never. Live ones may be withdrawn
    double ghostFrames = 0.0;    ///< so far
    bool claimed() const { return status == Status::Live || status == Status::Settled; }
};

/// To the last change of light in the log that came alone: with another kind of event in the same
/// frame there is no telling what is a response to what. NotMeasured where the pane had other
/// settings in that frame than `settings`, which are those of the pane now.
LiveResponse liveResponse(const ProbeLog& log, std::size_t probe, std::size_t pane,
                          std::string_view settings);

/// To the marks of log.frames()[index], up to the next frame in which anything happens that
/// concerns the pane. Waiting if they are not a change of light alone.
LiveResponse responseTo(const ProbeLog& log, std::size_t probe, std::size_t pane,
                        std::size_t index);

/// "3"; "> 26": not within the frames that were measured; "not yet" while more may come.
std::string timeText(const LiveResponse& response, const std::optional<int>& frames);
/// "1.2", or "> 1.2" where the response was cut short on its way.
std::string ghostText(const LiveResponse& response);
/// "settled", "live, 12", "step too small": in the room of a table's column.
std::string statusText(const LiveResponse& response);
/// "key off: t50 1, t90 3, 1.2 ghost frames (settled)"
std::string describe(const LiveResponse& response);

} // namespace afterglow
