// SPDX-License-Identifier: MIT
#include "app/measure/probe_csv.h"

#include "app/measure/live_response.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

namespace afterglow {
namespace {

constexpr std::string_view kHead =
    "frame,event,probe,x,y,width,height,pane,name,pixels,lit,raw_lit,"
    "raw_variance,variance,lambda,alpha,history,response\n";

std::string inQuotes(std::string_view text) {
    if (text.find_first_of(",\"\r\n") == std::string_view::npos)
        return std::string(text);
    std::string out = "\"";
    for (const char character : text)
        out += character == '"' ? std::string("\"\"") : std::string(1, character);
    return out + "\"";
}

std::string written(double value) {
    if (!std::isfinite(value))
        return {};
    std::array<char, 32> text;
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string eventsOf(const ProbeFrame& frame) {
    std::string events;
    for (const ProbeMark& mark : frame.marks)
        events += (events.empty() ? "" : "; ") + mark.text;
    return events;
}

/// By index of the log's frames; empty where none is claimed.
using Curve = std::vector<std::optional<double>>;

Curve curveOf(const ProbeLog& log, std::size_t probe, std::size_t pane) {
    Curve curve(log.frames().size());
    for (std::size_t i = 0; i < curve.size(); ++i) {
        const LiveResponse response = responseTo(log, probe, pane, i);
        for (std::size_t k = 0; k < response.p.size(); ++k)
            curve[i + k] = response.p[k];
    }
    return curve;
}

std::string rowOf(const ProbeFrame& frame, std::size_t probe, std::size_t pane,
                  const std::optional<double>& response) {
    const Probe& box = *frame.probes[probe];
    const ProbeSample& sample = *frame.samples[probe][pane];
    std::string row =
        std::to_string(frame.frame) + "," + inQuotes(eventsOf(frame)) + "," + letterOf(probe);
    for (const int value : {box.min.x, box.min.y, box.size.x, box.size.y})
        row += "," + std::to_string(value);
    row += std::string(",") + letterOf(pane) + "," + inQuotes(frame.panes[pane]) + "," +
           std::to_string(sample.pixels);
    for (const double value : {sample.lit, sample.rawLit, sample.rawVariance, sample.variance,
                               sample.lambda, sample.alpha, sample.history})
        row += "," + (sample.pixels > 0 ? written(value) : std::string());
    return row + "," + (response ? written(*response) : std::string()) + "\n";
}

} // namespace

std::string toCsv(const ProbeLog& log) {
    std::array<std::array<Curve, kPanes>, kProbes> curves;
    for (std::size_t probe = 0; probe < kProbes; ++probe)
        for (std::size_t pane = 0; pane < kPanes; ++pane)
            curves[probe][pane] = curveOf(log, probe, pane);
    std::string text(kHead);
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
