// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/image/metrics.h"
#include "renderer/image/separable_filter.h"

#include <vector>

namespace afterglow {

/// The difference that an eye sees when it flips between two pictures, after Andersson, Nilsson,
/// Akenine-Möller, Oskarsson, Åström, Fairchild: "ꟻLIP: A Difference Evaluator for Alternating
/// Images", HPG 2020. The variant for displays (LDR), of display pixels: sRGB-encoded, alpha is
/// ignored.
///
/// The reference is prepared once for many images. Beyond the border the nearest pixel repeats, and
/// filters end at three standard deviations (of the widest Gaussian for color), both as in the
/// authors' implementation. Filters are separable exactly, not by approximation.
///
/// compare() may be called from several threads.
class Flip {
public:
    /// At 0.7 m from a display 0.7 m and 3840 pixels wide, the authors' default: 67.02. The formula
    /// is theirs, without a tangent: the width of a pixel over the distance, in degrees.
    static constexpr double kPixelsPerDegree = 0.7 * (3840.0 / 0.7) * 3.14159265358979324 / 180.0;

    /// Prepares a reference. Throws std::logic_error if it is empty, or the pixels per degree are
    /// not in [1, 1000].
    explicit Flip(const Image<glm::u8vec4>& reference, double pixelsPerDegree = kPixelsPerDegree);

    /// Returns the error of each pixel in [0, 1], and its mean. Throws std::logic_error for an
    /// image of another size than the reference, and for a mask of another size or with nothing in
    /// it.
    MeasuredImage compare(const Image<glm::u8vec4>& image, const Mask* mask = nullptr) const;

private:
    struct Filters {
        explicit Filters(double pixelsPerDegree);

        /// Contrast sensitivity to Y, Cx and Cz: the sum of these Gaussians, each of them the
        /// product of its weights along both axes.
        std::vector<Weights> sensitivity[3];
        /// A Gaussian and its derivatives; along the other axis, a feature has the Gaussian.
        Weights smooth, edge, point;
    };
    /// A picture as an eye sees it.
    struct Percept {
        Image<glm::dvec3> color;     ///< CIE L*a*b* after contrast sensitivity, adjusted after Hunt
        Image<double> edges, points; ///< how strong, in [0, sqrt(2)]
    };

    Percept perceive(const Image<glm::u8vec4>& image) const;

    Filters filters_;
    Percept reference_;
};

} // namespace afterglow
