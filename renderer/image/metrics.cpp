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

/// Calls visit(x, r) with each pair of values that counts, and returns how many there were.
template <class Visit>
std::size_t forEachPair(const Image<float>& image, const Image<float>& reference, const Mask* mask,
                        Visit visit) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < image.pixels().size(); ++i) {
        if (mask && mask->pixels()[i] == 0)
            continue;
        visit(double(image.pixels()[i]), double(reference.pixels()[i]));
        ++count;
    }
    return count;
}

template <class Visit>
std::size_t forEachPair(const Image<glm::vec4>& image, const Image<glm::vec4>& reference,
                        const Mask* mask, Visit visit) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < image.pixels().size(); ++i) {
        if (mask && mask->pixels()[i] == 0)
            continue;
        for (int channel = 0; channel < 3; ++channel)
            visit(double(image.pixels()[i][channel]), double(reference.pixels()[i][channel]));
        count += 3;
    }
    return count;
}

/// The mean of value(x, r) over all pairs that count.
template <class Pixel, class Value>
double meanOf(const Image<Pixel>& image, const Image<Pixel>& reference, const Mask* mask,
              Value value) {
    checkSizes(image.size(), reference.size(), mask);
    double sum = 0.0;
    const std::size_t count =
        forEachPair(image, reference, mask, [&](double x, double r) { sum += value(x, r); });
    if (count == 0)
        throw std::logic_error("images to be compared must have a pixel that counts");
    return sum / double(count);
}

template <class Pixel>
double rootMeanSquare(const Image<Pixel>& image, const Image<Pixel>& reference, const Mask* mask) {
    return std::sqrt(
        meanOf(image, reference, mask, [](double x, double r) { return (x - r) * (x - r); }));
}

template <class Pixel>
double relativeMeanSquare(const Image<Pixel>& image, const Image<Pixel>& reference,
                          const Mask* mask) {
    const double floor =
        0.01 * meanOf(image, reference, mask, [](double, double r) { return r * r; });
    return meanOf(image, reference, mask, [&](double x, double r) {
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

std::size_t countOf(const Mask& mask) {
    return std::size_t(std::count_if(mask.pixels().begin(), mask.pixels().end(),
                                     [](std::uint8_t value) { return value != 0; }));
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

double flicker(const std::vector<Image<float>>& frames, const Mask* mask) {
    if (frames.empty())
        throw std::logic_error("flicker needs a frame");
    // Welford's update: the difference of two large sums would lose a small deviation.
    Image<double> mean(frames.front().size()), squares(frames.front().size());
    double count = 0.0;
    for (const Image<float>& frame : frames) {
        checkSizes(frame.size(), mean.size(), mask);
        count += 1.0;
        for (std::size_t i = 0; i < frame.pixels().size(); ++i) {
            const double difference = frame.pixels()[i] - mean.pixels()[i];
            mean.pixels()[i] += difference / count;
            squares.pixels()[i] += difference * (frame.pixels()[i] - mean.pixels()[i]);
        }
    }
    double sum = 0.0;
    std::size_t pixels = 0;
    for (std::size_t i = 0; i < squares.pixels().size(); ++i) {
        if (mask && mask->pixels()[i] == 0)
            continue;
        sum += std::sqrt(squares.pixels()[i] / count);
        ++pixels;
    }
    if (pixels == 0)
        throw std::logic_error("flicker needs a pixel that counts");
    return sum / double(pixels);
}

} // namespace afterglow
