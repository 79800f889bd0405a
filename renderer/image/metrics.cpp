// SPDX-License-Identifier: MIT
#include "renderer/image/metrics.h"

#include "renderer/image/color.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace afterglow {
namespace {

void checkSizes(glm::ivec2 a, glm::ivec2 b, const Mask* mask) {
    if (a != b || (mask && mask->size() != a))
        throw std::logic_error("images to be compared, and their mask, must have one size");
}

/// Calls visit(i) with the index of each pixel that counts, and returns how many there were.
template <class Visit>
std::size_t forEachPixel(std::size_t pixels, const Mask* mask, Visit visit) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        if (mask && mask->pixels()[i] == 0)
            continue;
        visit(i);
        ++count;
    }
    if (count == 0)
        throw std::logic_error("images to be measured must have a pixel that counts");
    return count;
}

int channelsOf(const Image<float>&) {
    return 1;
}
template <class Color>
int channelsOf(const Image<Color>&) {
    return 3; // not alpha
}

double valueOf(float pixel, int) {
    return double(pixel);
}
template <class Color>
double valueOf(const Color& pixel, int channel) {
    return double(pixel[channel]);
}

/// Returns the mean of value(x, r) over all pairs that count.
template <class Pixel, class Value>
double meanOfPairs(const Image<Pixel>& image, const Image<Pixel>& reference, const Mask* mask,
                   Value value) {
    checkSizes(image.size(), reference.size(), mask);
    const int channels = channelsOf(image);
    double sum = 0.0;
    const std::size_t count = forEachPixel(image.pixels().size(), mask, [&](std::size_t i) {
        for (int channel = 0; channel < channels; ++channel)
            sum +=
                value(valueOf(image.pixels()[i], channel), valueOf(reference.pixels()[i], channel));
    });
    return sum / double(count * std::size_t(channels));
}

template <class Pixel>
double rootMeanSquare(const Image<Pixel>& image, const Image<Pixel>& reference, const Mask* mask) {
    return std::sqrt(
        meanOfPairs(image, reference, mask, [](double x, double r) { return (x - r) * (x - r); }));
}

template <class Pixel>
double relativeMeanSquare(const Image<Pixel>& image, const Image<Pixel>& reference,
                          const Mask* mask) {
    const double floor =
        0.01 * meanOfPairs(image, reference, mask, [](double, double r) { return r * r; });
    return meanOfPairs(image, reference, mask, [&](double x, double r) {
        const double squared = (x - r) * (x - r);
        return squared == 0.0 ? 0.0 : squared / (r * r + floor);
    });
}

double decibels(double peak, double error) {
    return error == 0.0 ? std::numeric_limits<double>::infinity() : 20.0 * std::log10(peak / error);
}

} // namespace

Image<float> luminanceOf(const Image<glm::vec4>& image) {
    Image<float> result(image.size());
    std::transform(image.pixels().begin(), image.pixels().end(), result.pixels().begin(),
                   [](const glm::vec4& c) { return luminance(glm::vec3(c)); });
    return result;
}

Image<float> channelOf(const Image<glm::vec4>& image, int channel) {
    Image<float> result(image.size());
    std::ranges::transform(image.pixels(), result.pixels().begin(),
                           [&](const glm::vec4& c) { return c[channel]; });
    return result;
}

Image<float> within(Image<float> image, const Mask& mask) {
    for (std::size_t i = 0; i < image.pixels().size(); ++i)
        if (mask.pixels()[i] == 0)
            image.pixels()[i] = 0.0f;
    return image;
}

Mask both(const Mask& a, const Mask& b) {
    Mask result = a;
    for (std::size_t i = 0; i < result.pixels().size(); ++i)
        result.pixels()[i] &= b.pixels()[i];
    return result;
}

std::size_t countOf(const Mask& mask) {
    return std::size_t(std::count_if(mask.pixels().begin(), mask.pixels().end(),
                                     [](std::uint8_t value) { return value != 0; }));
}

double meanOf(const Image<float>& map, const Mask* mask) {
    checkSizes(map.size(), map.size(), mask);
    double sum = 0.0;
    const std::size_t count = forEachPixel(map.pixels().size(), mask,
                                           [&](std::size_t i) { sum += double(map.pixels()[i]); });
    return sum / double(count);
}

double rmse(const Image<float>& image, const Image<float>& reference, const Mask* mask) {
    return rootMeanSquare(image, reference, mask);
}

double rmse(const Image<glm::vec4>& image, const Image<glm::vec4>& reference, const Mask* mask) {
    return rootMeanSquare(image, reference, mask);
}

double relMse(const Image<float>& image, const Image<float>& reference, const Mask* mask) {
    return relativeMeanSquare(image, reference, mask);
}

double relMse(const Image<glm::vec4>& image, const Image<glm::vec4>& reference, const Mask* mask) {
    return relativeMeanSquare(image, reference, mask);
}

double psnr(const Image<float>& image, const Image<float>& reference, double peak,
            const Mask* mask) {
    return decibels(peak, rmse(image, reference, mask));
}

double psnr(const Image<glm::vec4>& image, const Image<glm::vec4>& reference, double peak,
            const Mask* mask) {
    return decibels(peak, rmse(image, reference, mask));
}

double psnr(const Image<glm::u8vec4>& image, const Image<glm::u8vec4>& reference,
            const Mask* mask) {
    return decibels(255.0, rootMeanSquare(image, reference, mask));
}

double temporalError(const Image<glm::vec4>& now, const Image<glm::vec4>& before,
                     const Image<glm::vec4>& referenceNow, const Image<glm::vec4>& referenceBefore,
                     const Mask* mask) {
    checkSizes(now.size(), before.size(), mask);
    checkSizes(now.size(), referenceNow.size(), mask);
    checkSizes(now.size(), referenceBefore.size(), mask);
    double sum = 0.0;
    const std::size_t count = forEachPixel(now.pixels().size(), mask, [&](std::size_t i) {
        const glm::dvec3 change = glm::dvec3(now.pixels()[i]) - glm::dvec3(before.pixels()[i]);
        const glm::dvec3 expected =
            glm::dvec3(referenceNow.pixels()[i]) - glm::dvec3(referenceBefore.pixels()[i]);
        sum += glm::dot(change - expected, change - expected);
    });
    return std::sqrt(sum / double(3 * count));
}

void Flicker::add(const Image<glm::vec4>& frame) {
    if (frames_ == 0)
        mean_ = squares_ = Image<glm::dvec3>(frame.size(), glm::dvec3(0.0));
    checkSizes(frame.size(), mean_.size(), nullptr);
    ++frames_;
    // Welford's update: the difference of two large sums would lose a small deviation.
    for (std::size_t i = 0; i < frame.pixels().size(); ++i) {
        const glm::dvec3 value(frame.pixels()[i]), difference = value - mean_.pixels()[i];
        mean_.pixels()[i] += difference / double(frames_);
        squares_.pixels()[i] += difference * (value - mean_.pixels()[i]);
    }
}

double Flicker::mean(const Mask* mask) const {
    if (frames_ == 0)
        throw std::logic_error("flicker needs a frame");
    checkSizes(mean_.size(), mean_.size(), mask);
    double sum = 0.0;
    const std::size_t count = forEachPixel(squares_.pixels().size(), mask, [&](std::size_t i) {
        const glm::dvec3 deviation = glm::sqrt(squares_.pixels()[i] / double(frames_));
        sum += deviation.x + deviation.y + deviation.z;
    });
    return sum / double(3 * count);
}

} // namespace afterglow
