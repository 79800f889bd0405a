// SPDX-License-Identifier: MIT
#include "app/measure/response.h"

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

glm::dvec3 rgb(const Image<glm::vec4>& image, std::size_t pixel) {
    return glm::dvec3(image.pixels()[pixel]);
}

} // namespace

std::optional<PictureChange> PictureChange::between(Image<glm::vec4> before, Image<glm::vec4> after,
                                                    const Mask* counts) {
    constexpr double kLeastShare = 0.02;
    if (before.size() != after.size())
        throw std::logic_error("the references before and after an event must have one size");
    const std::size_t pixels = before.pixels().size();
    std::vector<double> squares(pixels);
    double greatest = 0.0;
    for (std::size_t i = 0; i < pixels; ++i) {
        if (counts && counts->pixels()[i] == 0)
            continue;
        const glm::dvec3 change = rgb(after, i) - rgb(before, i);
        squares[i] = glm::dot(change, change);
        if (!std::isfinite(squares[i]))
            return std::nullopt;
        greatest = std::max(greatest, squares[i]);
    }
    Mask mask(before.size());
    double energy = 0.0;
    for (std::size_t i = 0; i < pixels; ++i) {
        if (squares[i] > kLeastShare * kLeastShare * greatest) {
            mask.pixels()[i] = 1;
            energy += squares[i];
        }
    }
    if (energy == 0.0)
        return std::nullopt;
    return PictureChange(std::move(before), std::move(after), std::move(mask), energy);
}

double PictureChange::response(const Image<glm::vec4>& frame) const {
    if (frame.size() != before_.size())
        throw std::logic_error("a frame must have the size of its references");
    double sum = 0.0;
    for (std::size_t i = 0; i < frame.pixels().size(); ++i) {
        if (mask_.pixels()[i] == 0)
            continue;
        const glm::dvec3 old = rgb(before_, i);
        sum += glm::dot(rgb(frame, i) - old, rgb(after_, i) - old);
    }
    return sum / energy_;
}

double PictureChange::noise(const Image<glm::vec4>& frame) const {
    const double p = response(frame);
    double sum = 0.0;
    for (std::size_t i = 0; i < frame.pixels().size(); ++i) {
        if (mask_.pixels()[i] == 0)
            continue;
        // L - L+ - (p - 1)(L+ - L-), which is the same as:
        const glm::dvec3 old = rgb(before_, i);
        const glm::dvec3 rest = rgb(frame, i) - old - p * (rgb(after_, i) - old);
        sum += glm::dot(rest, rest);
    }
    return std::sqrt(sum / double(3 * countOf(mask_)));
}

double PictureChange::ghostEnergy(const Image<glm::vec4>& frame) const {
    double ghost = 0.0, change = 0.0;
    for (std::size_t i = 0; i < frame.pixels().size(); ++i) {
        if (mask_.pixels()[i] == 0)
            continue;
        const glm::dvec3 step = rgb(after_, i) - rgb(before_, i);
        const glm::dvec3 error = rgb(frame, i) - rgb(after_, i);
        for (int channel = 0; channel < 3; ++channel) {
            change += std::abs(step[channel]);
            ghost += std::max(0.0, step[channel] < 0.0 ? error[channel] : -error[channel]);
        }
    }
    return ghost / change;
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

std::optional<std::vector<double>> betweenOwnValues(std::span<const double> p, double start,
                                                    double end) {
    constexpr double kLeastStep = 0.05;
    if (!(end - start >= kLeastStep))
        return std::nullopt;
    std::vector<double> own;
    for (const double value : p)
        own.push_back((value - start) / (end - start));
    return own;
}

} // namespace afterglow
