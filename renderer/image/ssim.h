// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/image/metrics.h"

namespace afterglow {

/// Returns the structural similarity, after Wang, Bovik, Sheikh, Simoncelli: "Image Quality
/// Assessment: From Error Visibility to Structural Similarity", IEEE Transactions on Image
/// Processing 13(4), 2004, section III: a Gaussian window of 11 x 11 pixels with a standard
/// deviation of 1.5, K1 = 0.01, K2 = 0.03, covariance of the population. Between -1 and 1; 1 for
/// equal images, and it is symmetric.
///
/// Of display pixels: sRGB-encoded, 255 counts as 1, alpha is ignored. Departs from the paper,
/// which is about gray: the map is the mean over red, green and blue.
///
/// The map is of the size of the images; where the window reaches over the border, the nearest
/// pixel repeats. Those pixels, 5 along each side, do not count in the mean, as in the paper. Along
/// an axis with fewer than 11 pixels, fewer do not count, so that the middle pixel (or two) does. A
/// mask leaves further pixels out of the mean, but not out of their neighbors' windows; if it has
/// none but near the border, these count after all. Images of unequal size, or a mask with nothing
/// in it, are a std::logic_error.
MeasuredImage ssim(const Image<glm::u8vec4>& image, const Image<glm::u8vec4>& reference,
                   const Mask* mask = nullptr);

} // namespace afterglow
