// SPDX-License-Identifier: MIT
#include "app/measure/probe_csv.h"

#include "app/measure/live_response.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace afterglow {
namespace {

constexpr std::string_view kHead =
    "frame,event,probe,x,y,width,height,pane,name,pixels,lit,raw_lit,"
    "raw_variance,variance,lambda,alpha,history,response\n";

std::string inQuotes(std::string_view text) {
    if (text.find_first_of(",\"#\r\n") == std::string_view::npos)
        return std::string(text);
    std::string out = "\"";
    for (const char character : text)
        out += character == '"' ? std::string("\"\"") : std::string(1, character);
    return out + "\"";
}

std::string written(double value) {
    return std::isfinite(value) ? fmt::format("{}", value) : std::string();
}

std::string eventsOf(const ProbeFrame& frame) {
    std::string events;
    for (const ProbeMark& mark : frame.marks)
        events += (events.empty() ? "" : "; ") + mark.text;
    return events;
}

/// Returns one line, whatever breaks the text has.
std::string fact(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return "# " + text + "\n";
}

/// A response by index of the log's frames; empty where none is claimed.
using Curve = std::vector<std::optional<double>>;

/// Fills the curve of a pane at a probe, and adds a line for every change of light that it met.
Curve curveOf(const ProbeLog& log, std::size_t probe, std::size_t pane, std::string& facts) {
    Curve curve(log.frames().size());
    for (std::size_t i = 0; i < curve.size(); ++i) {
        const ProbeFrame& frame = log.frames()[i];
        const LiveResponse response = responseTo(log, probe, pane, i);
        for (std::size_t k = 0; k < response.p.size(); ++k)
            curve[i + k] = response.p[k];
        if (!response.event.empty() && frame.samples[probe][pane])
            facts += fact(fmt::format("result: probe {}, pane {}, {}, frame {}, {}",
                                      letterOf(probe), letterOf(pane), frame.panes[pane].title,
                                      frame.frame, describe(response)));
    }
    return curve;
}

std::string settingsFacts(const ProbeLog& log, std::size_t pane) {
    std::string facts;
    const ProbePane* last = nullptr;
    for (const ProbeFrame& frame : log.frames()) {
        const ProbePane& now = frame.panes[pane];
        if (now.title.empty() || (last && now == *last))
            continue;
        facts += fact(fmt::format("pane {} from frame {}: {}: {}", letterOf(pane), frame.frame,
                                  now.title, now.settings));
        last = &now;
    }
    return facts;
}

std::string rowOf(const ProbeFrame& frame, std::size_t probe, std::size_t pane,
                  const std::optional<double>& response) {
    const Probe& box = *frame.probes[probe];
    const ProbeSample& sample = *frame.samples[probe][pane];
    std::string row =
        fmt::format("{},{},{},{},{},{},{},{},{},{}", frame.frame, inQuotes(eventsOf(frame)),
                    letterOf(probe), box.min.x, box.min.y, box.size.x, box.size.y, letterOf(pane),
                    inQuotes(frame.panes[pane].title), sample.pixels);
    for (const double value : {sample.lit, sample.rawLit, sample.rawVariance, sample.variance,
                               sample.lambda, sample.alpha, sample.history})
        row += "," + (sample.pixels > 0 ? written(value) : std::string());
    return row + "," + (response ? written(*response) : std::string()) + "\n";
}

} // namespace

std::string toCsv(const ProbeLog& log, const ProbeRun& run) {
    std::string facts = fact("scene: " + run.scene) + fact(fmt::format("seed: {}", run.seed)) +
                        fact(fmt::format("size: {}x{}", run.size.x, run.size.y));
    for (std::size_t pane = 0; pane < kPanes; ++pane)
        facts += settingsFacts(log, pane);
    for (const ProbeFrame& frame : log.frames())
        if (!frame.marks.empty())
            facts += fact(fmt::format("event: frame {}, {}", frame.frame, eventsOf(frame)));
    std::array<std::array<Curve, kPanes>, kProbes> curves;
    for (std::size_t probe = 0; probe < kProbes; ++probe)
        for (std::size_t pane = 0; pane < kPanes; ++pane)
            curves[probe][pane] = curveOf(log, probe, pane, facts);
    std::string text = facts + std::string(kHead);
    for (std::size_t i = 0; i < log.frames().size(); ++i) {
        const ProbeFrame& frame = log.frames()[i];
        for (std::size_t probe = 0; probe < kProbes; ++probe)
            for (std::size_t pane = 0; pane < kPanes; ++pane)
                if (frame.samples[probe][pane])
                    text += rowOf(frame, probe, pane, curves[probe][pane][i]);
    }
    return text;
}

} // namespace afterglow
