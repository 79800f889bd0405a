// SPDX-License-Identifier: MIT
#include "app/measure/probe_log.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace afterglow {
namespace {

void requireSize(glm::ivec2 size) {
    if (size.x < 1 || size.y < 1)
        throw std::logic_error("a probe needs a picture of at least one pixel");
}

/// Pixels [low, low + size) of a row of `from` pixels, in one of `to`.
std::pair<int, int> rescaledRow(int low, int size, int from, int to) {
    const double scale = double(to) / double(from);
    int begin = int(std::lround(low * scale)), end = int(std::lround((low + size) * scale));
    if (end <= begin) {
        begin = int(std::floor((low + 0.5 * size) * scale));
        end = begin + 1;
    }
    begin = std::clamp(begin, 0, to - 1);
    return {begin, std::clamp(end, begin + 1, to) - begin};
}

constexpr glm::vec2 kUnit{0.0f, 1.0f};
constexpr QuantityInfo kQuantities[] = {
    {ProbeQuantity::Lit, "luminance", "", std::nullopt, false, &ProbeSample::lit},
    {ProbeQuantity::RawLit, "noisy luminance", "", std::nullopt, false, &ProbeSample::rawLit},
    {ProbeQuantity::Lambda, "lambda", "", kUnit, false, &ProbeSample::lambda},
    {ProbeQuantity::Alpha, "alpha", "", kUnit, false, &ProbeSample::alpha},
    {ProbeQuantity::History, "history", "frames", std::nullopt, false, &ProbeSample::history},
    {ProbeQuantity::RawVariance, "noisy variance", "", std::nullopt, true,
     &ProbeSample::rawVariance},
    {ProbeQuantity::Variance, "variance", "", std::nullopt, true, &ProbeSample::variance}};

} // namespace

Probe probeAt(glm::ivec2 pixel, glm::ivec2 image) {
    return probeBetween(pixel, pixel, image);
}

Probe probeAround(glm::ivec2 pixel, glm::ivec2 image) {
    requireSize(image);
    const glm::ivec2 size = glm::min(glm::ivec2(kClickBox), image);
    return {glm::clamp(pixel - kClickBox / 2, glm::ivec2(0), image - size), size};
}

Probe probeBetween(glm::ivec2 corner, glm::ivec2 opposite, glm::ivec2 image) {
    requireSize(image);
    const glm::ivec2 last = image - 1;
    const glm::ivec2 a = glm::clamp(corner, glm::ivec2(0), last);
    const glm::ivec2 b = glm::clamp(opposite, glm::ivec2(0), last);
    return {glm::min(a, b), glm::abs(a - b) + 1};
}

Probe rescaled(const Probe& probe, glm::ivec2 from, glm::ivec2 to) {
    requireSize(from);
    requireSize(to);
    const auto [x, width] = rescaledRow(probe.min.x, probe.size.x, from.x, to.x);
    const auto [y, height] = rescaledRow(probe.min.y, probe.size.y, from.y, to.y);
    return {{x, y}, {width, height}};
}

void ProbeLog::add(ProbeFrame frame) {
    for (std::size_t probe = 0; probe < kProbes; ++probe) {
        for (std::size_t pane = 0; pane < kPanes; ++pane)
            if (frame.samples[probe][pane] &&
                (!frame.probes[probe] || frame.panes[pane].title.empty()))
                throw std::logic_error("a probe's sample needs its probe and its pane");
    }
    if (!frames_.empty()) {
        const ProbeFrame& last = frames_.back();
        for (std::size_t pane = 0; pane < kPanes; ++pane) {
            const ProbePane &now = frame.panes[pane], &before = last.panes[pane];
            if (now.title.empty() || before.title.empty() || now.settings == before.settings)
                continue;
            const std::string what = now.title == before.title ? "new settings" : now.title;
            frame.marks.push_back({.text = fmt::format("pane {}: {}", letterOf(pane), what),
                                   .step = false,
                                   .pane = pane});
        }
        for (std::size_t probe = 0; probe < kProbes; ++probe)
            if (frame.probes[probe] != last.probes[probe])
                restart(probe);
    }
    frames_.push_back(std::move(frame));
    if (frames_.size() > kFrames)
        frames_.pop_front();
}

void ProbeLog::restart(std::size_t probe) {
    for (ProbeFrame& frame : frames_)
        frame.samples.at(probe) = {};
}

const ProbeSample* ProbeLog::measured(std::size_t index, std::size_t probe,
                                      std::size_t pane) const {
    const auto& sample = frames_.at(index).samples.at(probe).at(pane);
    if (!sample || sample->pixels == 0 || !std::isfinite(sample->lit) ||
        !std::isfinite(sample->rawLit) || !std::isfinite(sample->rawVariance))
        return nullptr;
    return &*sample;
}

std::span<const QuantityInfo> quantities() {
    return kQuantities;
}

const QuantityInfo& infoOf(ProbeQuantity quantity) {
    return kQuantities[std::size_t(quantity)];
}

std::vector<float> seriesOf(const ProbeLog& log, std::size_t probe, std::size_t pane,
                            ProbeQuantity quantity) {
    constexpr float kGap = std::numeric_limits<float>::quiet_NaN();
    const auto value = infoOf(quantity).value;
    std::vector<float> series;
    series.reserve(log.frames().size());
    for (const ProbeFrame& frame : log.frames()) {
        const auto& sample = frame.samples.at(probe).at(pane);
        const bool counts = sample && sample->pixels > 0 && std::isfinite(*sample.*value);
        series.push_back(counts ? float(*sample.*value) : kGap);
    }
    return series;
}

} // namespace afterglow
