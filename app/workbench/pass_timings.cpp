#include "app/workbench/pass_timings.h"

#include <algorithm>
#include <numeric>

namespace afterglow {
namespace {

constexpr double kNewest = 0.1;       // weight of the newest frame in an average
constexpr std::size_t kMedianOf = 15; // frames

} // namespace

void PassTimings::addPasses(std::span<const Row> passes) {
    std::vector<Row> next(passes.begin(), passes.end());
    std::vector<int> seen(next.size(), 1);
    for (std::size_t i = 0; i < next.size(); ++i) {
        const auto before = std::ranges::find(passes_, next[i].name, &Row::name);
        if (before == passes_.end())
            continue;
        seen[i] = seen_[std::size_t(before - passes_.begin())] + 1;
        const double weight = std::max(kNewest, 1.0 / double(seen[i] - 1));
        next[i].milliseconds =
            before->milliseconds + weight * (next[i].milliseconds - before->milliseconds);
    }
    passes_ = std::move(next);
    seen_ = std::move(seen);
}

void PassTimings::addFrame(double milliseconds) {
    if (ring_.size() == kFrames)
        ring_.erase(ring_.begin());
    ring_.push_back(float(milliseconds));
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

} // namespace afterglow
