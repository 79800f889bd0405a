#include "app/experiment/response.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace afterglow {
namespace {

/// The index from which holds(value) is true to the end.
template <class Holds>
std::optional<int> startOfTail(std::span<const double> values, Holds holds) {
    std::size_t start = values.size();
    while (start > 0 && holds(values[start - 1]))
        --start;
    if (start == values.size())
        return std::nullopt;
    return int(start);
}

} // namespace

std::optional<StepChange> StepChange::between(Image<float> before, Image<float> after) {
    constexpr double kLeastShare = 0.02;
    if (before.size() != after.size())
        throw std::logic_error("the references before and after an event must have one size");
    double greatest = 0.0;
    for (std::size_t i = 0; i < before.pixels().size(); ++i) {
        const double change = std::abs(double(after.pixels()[i]) - double(before.pixels()[i]));
        if (!std::isfinite(change))
            return std::nullopt;
        greatest = std::max(greatest, change);
    }
    Mask mask(before.size());
    double energy = 0.0;
    for (std::size_t i = 0; i < before.pixels().size(); ++i) {
        const double change = double(after.pixels()[i]) - double(before.pixels()[i]);
        if (std::abs(change) > kLeastShare * greatest) {
            mask.pixels()[i] = 1;
            energy += change * change;
        }
    }
    if (energy == 0.0)
        return std::nullopt;
    return StepChange(std::move(before), std::move(after), std::move(mask), energy);
}

double StepChange::response(const Image<float>& frame) const {
    if (frame.size() != before_.size())
        throw std::logic_error("a frame must have the size of its references");
    double sum = 0.0;
    for (std::size_t i = 0; i < frame.pixels().size(); ++i) {
        if (mask_.pixels()[i] == 0)
            continue;
        const double old = before_.pixels()[i];
        sum += (frame.pixels()[i] - old) * (after_.pixels()[i] - old);
    }
    return sum / energy_;
}

double StepChange::noise(const Image<float>& frame) const {
    const double p = response(frame);
    double sum = 0.0;
    for (std::size_t i = 0; i < frame.pixels().size(); ++i) {
        if (mask_.pixels()[i] == 0)
            continue;
        // L - L+ - (p - 1)(L+ - L-), which is the same as:
        const double old = before_.pixels()[i];
        const double rest = frame.pixels()[i] - old - p * (after_.pixels()[i] - old);
        sum += rest * rest;
    }
    return std::sqrt(sum / double(countOf(mask_)));
}

std::optional<int> framesUntilAbove(std::span<const double> p, double level) {
    return startOfTail(p, [&](double value) { return value > level; });
}

double ghostFrames(std::span<const double> p) {
    double sum = 0.0;
    for (const double value : p)
        sum += std::max(0.0, 1.0 - value);
    return sum;
}

std::optional<int> framesUntilSettled(std::span<const double> noise, double settled,
                                      double tolerance) {
    return startOfTail(
        noise, [&](double value) { return std::abs(value - settled) <= tolerance * settled; });
}

double settledValue(std::span<const double> values, int window) {
    if (values.empty() || window < 1)
        throw std::logic_error("a settled value is the mean of at least one value");
    const auto tail = values.last(std::min(values.size(), std::size_t(window)));
    double sum = 0.0;
    for (const double value : tail)
        sum += value;
    return sum / double(tail.size());
}

ResponseSummary summarize(std::span<const double> p) {
    if (p.empty())
        throw std::logic_error("a response curve has at least one frame");
    return {.t50 = framesUntilAbove(p, 0.5),
            .t90 = framesUntilAbove(p, 0.9),
            .t99 = framesUntilAbove(p, 0.99),
            .ghostFrames = ghostFrames(p),
            .overshoot = *std::max_element(p.begin(), p.end()) - 1.0};
}

} // namespace afterglow
