// SPDX-License-Identifier: MIT
#include "renderer/image/flip.h"

#include "renderer/image/color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace afterglow {
namespace {

using Planes = std::array<Image<double>, 3>;

// Section 4.1: a and b of the Gaussians a exp(-b f^2), f in cycles per degree, that model the
// contrast sensitivity. Of Y (gray) and Cx (red-green) one each, of Cz (blue-yellow) two.
struct Sensitivity {
    double a, b;
};
const std::array<std::vector<Sensitivity>, 3> kSensitivity = {
    {{{1.0, 0.0047}}, {{1.0, 0.0053}}, {{34.1, 0.04}, {13.5, 0.025}}}};
constexpr double kWidestSensitivity = 0.04;

constexpr double kColorExponent = 0.7;    // q_c, section 4.1
constexpr double kKneeOfLargest = 0.4;    // p_c: at this part of the largest color error ...
constexpr double kErrorAtKnee = 0.95;     // p_t: ... the error is this
constexpr double kFeatureDegrees = 0.082; // w, section 4.2: the edge detector, peak to trough

/// Returns the matrix to X, Y and Z over those of white, from linear sRGB; every row adds up to
/// one. The rational numbers are the authors': they follow from the primaries of IEC 61966-2-1 with
/// D65 at (0.31271, 0.32902), where the standard rounds to (0.3127, 0.3290).
glm::dmat3 relativeXyzFromRgb() {
    return glm::transpose(glm::dmat3(glm::dvec3(10135552.0, 8788810.0, 4435075.0) / 23359437.0,
                                     glm::dvec3(2613072.0, 8788810.0, 887015.0) / 12288897.0,
                                     glm::dvec3(1425312.0, 8788810.0, 70074185.0) / 80288307.0));
}

// YCxCz is L*a*b* without its cube root. Both take X, Y and Z relative to those of white.

glm::dvec3 opponentFromXyz(const glm::dvec3& xyz) {
    return {116.0 * xyz.y - 16.0, 500.0 * (xyz.x - xyz.y), 200.0 * (xyz.y - xyz.z)};
}

glm::dvec3 xyzFromOpponent(const glm::dvec3& c) {
    const double y = (c[0] + 16.0) / 116.0;
    return {y + c[1] / 500.0, y, y - c[2] / 200.0};
}

/// Converts to CIE L*a*b*, with a* and b* scaled by lightness: after Hunt, colorfulness grows with
/// luminance.
glm::dvec3 huntLabFromXyz(const glm::dvec3& xyz) {
    const auto root = [](double t) {
        constexpr double kDelta = 6.0 / 29.0;
        return t > kDelta * kDelta * kDelta ? std::cbrt(t)
                                            : t / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
    };
    const glm::dvec3 lab = opponentFromXyz({root(xyz.x), root(xyz.y), root(xyz.z)});
    return {lab[0], 0.01 * lab[0] * lab[1], 0.01 * lab[0] * lab[2]};
}

/// Returns the distance HyAB: city block between lightness and chroma, which is Euclidean.
double hyab(const glm::dvec3& p, const glm::dvec3& q) {
    const glm::dvec3 d = p - q;
    return std::abs(d[0]) + std::sqrt(d[1] * d[1] + d[2] * d[2]);
}

/// Returns the exponentiated distance of the two corners of the sRGB cube that are furthest apart.
double largestColorError() {
    const glm::dmat3 xyzFromRgb = relativeXyzFromRgb();
    return std::pow(hyab(huntLabFromXyz(xyzFromRgb[1]), huntLabFromXyz(xyzFromRgb[2])),
                    kColorExponent); // green and blue
}

/// Returns the exponentiated distance of two colors, mapped to [0, 1] in two straight pieces.
double colorError(const glm::dvec3& p, const glm::dvec3& q, double largest) {
    const double error = std::pow(hyab(p, q), kColorExponent), knee = kKneeOfLargest * largest;
    return error < knee ? kErrorAtKnee / knee * error
                        : kErrorAtKnee + (error - knee) / (largest - knee) * (1.0 - kErrorAtKnee);
}

double sumOf(const Weights& weights) {
    return std::accumulate(weights.begin(), weights.end(), 0.0);
}

Weights scaled(Weights weights, double factor) {
    for (double& weight : weights)
        weight *= factor;
    return weights;
}

/// Scales weights so that the positive ones add up to 1, the negative ones to -1.
Weights normalizedBySign(Weights weights) {
    double positive = 0.0, negative = 0.0;
    for (double weight : weights)
        (weight > 0.0 ? positive : negative) += std::abs(weight);
    for (double& weight : weights) {
        if (weight != 0.0)
            weight /= weight > 0.0 ? positive : negative;
    }
    return weights;
}

/// Returns the Gaussians of one channel. In space, a exp(-b f^2) is proportional to a sqrt(pi / b)
/// exp(-pi^2 x^2 / b), x in degrees; all together have the sum 1. A factor in front of one is split
/// evenly between the axes.
std::vector<Weights> sensitivityWeights(const std::vector<Sensitivity>& gaussians,
                                        double pixelsPerDegree) {
    constexpr double kPi = std::numbers::pi;
    const int radius =
        int(std::ceil(3.0 * std::sqrt(kWidestSensitivity / (2.0 * kPi * kPi)) * pixelsPerDegree));
    std::vector<Weights> result;
    double total = 0.0;
    for (const auto [a, b] : gaussians) {
        const double height = std::sqrt(a * std::sqrt(kPi / b));
        result.push_back(weightsOf(radius, [&, b = b](int i) {
            const double degrees = i / pixelsPerDegree;
            return height * std::exp(-kPi * kPi * degrees * degrees / b);
        }));
        total += std::pow(sumOf(result.back()), 2.0);
    }
    for (Weights& weights : result)
        weights = scaled(std::move(weights), 1.0 / std::sqrt(total));
    return result;
}

Planes opponentPlanes(const Image<glm::u8vec4>& image) {
    std::array<double, 256> linear;
    for (std::size_t i = 0; i < linear.size(); ++i)
        linear[i] = decodeSrgb(double(i) / 255.0);
    const glm::dmat3 xyzFromRgb = relativeXyzFromRgb();
    Planes planes;
    planes.fill(Image<double>(image.size()));
    for (std::size_t i = 0; i < image.pixels().size(); ++i) {
        const glm::u8vec4 p = image.pixels()[i];
        const glm::dvec3 color =
            opponentFromXyz(xyzFromRgb * glm::dvec3(linear[p.r], linear[p.g], linear[p.b]));
        for (int channel = 0; channel < 3; ++channel)
            planes[std::size_t(channel)].pixels()[i] = color[channel];
    }
    return planes;
}

Image<double> filtered(const Image<double>& plane, const std::vector<Weights>& sensitivity) {
    Image<double> sum(plane.size());
    for (const Weights& weights : sensitivity) {
        const Image<double> one = filterColumns(filterRows(plane, weights), weights);
        std::transform(sum.pixels().begin(), sum.pixels().end(), one.pixels().begin(),
                       sum.pixels().begin(), std::plus<>());
    }
    return sum;
}

Image<glm::dvec3> perceivedColor(const Planes& seen) {
    const glm::dmat3 xyzFromRgb = relativeXyzFromRgb(), rgbFromXyz = glm::inverse(xyzFromRgb);
    Image<glm::dvec3> result(seen[0].size());
    for (std::size_t i = 0; i < result.pixels().size(); ++i) {
        const glm::dvec3 opponent(seen[0].pixels()[i], seen[1].pixels()[i], seen[2].pixels()[i]);
        const glm::dvec3 rgb = rgbFromXyz * xyzFromOpponent(opponent);
        result.pixels()[i] =
            huntLabFromXyz(xyzFromRgb * glm::clamp(rgb, 0.0, 1.0)); // what a display can show
    }
    return result;
}

/// Returns the length of the gradient whose parts are a feature along x and along y.
Image<double> strength(Image<double> alongX, const Image<double>& alongY) {
    std::transform(alongX.pixels().begin(), alongX.pixels().end(), alongY.pixels().begin(),
                   alongX.pixels().begin(),
                   [](double x, double y) { return std::sqrt(x * x + y * y); });
    return alongX;
}

} // namespace

Flip::Filters::Filters(double pixelsPerDegree) {
    if (!(pixelsPerDegree >= 1.0 && pixelsPerDegree <= 1000.0))
        throw std::logic_error("FLIP needs between 1 and 1000 pixels per degree");
    for (std::size_t channel = 0; channel < 3; ++channel)
        sensitivity[channel] = sensitivityWeights(kSensitivity[channel], pixelsPerDegree);

    const double deviation = 0.5 * kFeatureDegrees * pixelsPerDegree;
    const int radius = int(std::ceil(3.0 * deviation));
    const auto gaussian = [&](int i) { return std::exp(-0.5 * i * i / (deviation * deviation)); };
    smooth = normalizedBySign(weightsOf(radius, gaussian));
    edge = normalizedBySign(weightsOf(radius, [&](int i) { return -i * gaussian(i); }));
    point = normalizedBySign(weightsOf(
        radius, [&](int i) { return (i * i / (deviation * deviation) - 1.0) * gaussian(i); }));
}

Flip::Flip(const Image<glm::u8vec4>& reference, double pixelsPerDegree)
    : filters_(pixelsPerDegree), reference_(perceive(reference)) {
    if (reference.pixels().empty())
        throw std::logic_error("FLIP needs a pixel");
}

Flip::Percept Flip::perceive(const Image<glm::u8vec4>& image) const {
    Planes planes = opponentPlanes(image);
    Image<double> gray = planes[0];
    for (double& value : gray.pixels())
        value = (value + 16.0) / 116.0;
    for (std::size_t channel = 0; channel < 3; ++channel)
        planes[channel] = filtered(planes[channel], filters_.sensitivity[channel]);

    const Image<double> smooth = filterRows(gray, filters_.smooth);
    const auto feature = [&](const Weights& weights) {
        return strength(filterColumns(filterRows(gray, weights), filters_.smooth),
                        filterColumns(smooth, weights));
    };
    return {perceivedColor(planes), feature(filters_.edge), feature(filters_.point)};
}

MeasuredImage Flip::compare(const Image<glm::u8vec4>& image, const Mask* mask) const {
    if (image.size() != reference_.color.size() || (mask && mask->size() != image.size()))
        throw std::logic_error("images to be compared, and their mask, must have one size");
    const Percept percept = perceive(image);
    const double largest = largestColorError();
    MeasuredImage result{.map = Image<float>(image.size())};
    for (std::size_t i = 0; i < result.map.pixels().size(); ++i) {
        const double color =
            colorError(percept.color.pixels()[i], reference_.color.pixels()[i], largest);
        const double feature =
            std::max(std::abs(percept.edges.pixels()[i] - reference_.edges.pixels()[i]),
                     std::abs(percept.points.pixels()[i] - reference_.points.pixels()[i]));
        result.map.pixels()[i] =
            float(std::pow(color, 1.0 - std::sqrt(feature / std::numbers::sqrt2)));
    }
    result.mean = meanOf(result.map, mask);
    return result;
}

} // namespace afterglow
