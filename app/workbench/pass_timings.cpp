// SPDX-License-Identifier: MIT
#include "app/workbench/pass_timings.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

namespace afterglow {
namespace {

constexpr double kNewest = 0.1;       // weight of the newest frame in an average
constexpr std::size_t kMedianOf = 15; // frames

void push(std::vector<float>& ring, double milliseconds) {
    if (ring.size() == PassTimings::kFrames)
        ring.erase(ring.begin());
    ring.push_back(float(milliseconds));
}

} // namespace

void PassTimings::addPasses(std::span<const Row> passes) {
    std::vector<Row> next(passes.begin(), passes.end());
    std::vector<std::vector<float>> rings(next.size());
    for (std::size_t i = 0; i < next.size(); ++i) {
        const double newest = next[i].milliseconds;
        const auto before = std::ranges::find(passes_, next[i].name, &Row::name);
        if (before != passes_.end()) {
            rings[i] = std::move(rings_[std::size_t(before - passes_.begin())]);
            const double weight = std::max(kNewest, 1.0 / double(rings[i].size() + 1));
            next[i].milliseconds = before->milliseconds + weight * (newest - before->milliseconds);
        }
        push(rings[i], newest);
    }
    passes_ = std::move(next);
    rings_ = std::move(rings);
}

void PassTimings::addFrame(double milliseconds) {
    push(ring_, milliseconds);
}

double PassTimings::frame() const {
    if (ring_.empty())
        return 0.0;
    const std::size_t count = std::min(ring_.size(), kMedianOf);
    std::vector<float> newest(ring_.end() - std::ptrdiff_t(count), ring_.end());
    std::ranges::nth_element(newest, newest.begin() + std::ptrdiff_t(count / 2));
    return double(newest[count / 2]);
}

double PassTimings::passTotal() const {
    return std::accumulate(passes_.begin(), passes_.end(), 0.0,
                           [](double sum, const Row& row) { return sum + row.milliseconds; });
}

std::string timeText(const PassTimings& timings) {
    return timings.frames().empty() ? "compiling" : fmt::format("{:.1f} ms", timings.frame());
}

} // namespace afterglow
