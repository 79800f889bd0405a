// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/image/image.h"

#include <cstdint>
#include <vector>

namespace afterglow {

/// The pixels that count: those that are not 0.
using Mask = Image<std::uint8_t>;

/// Returns the Rec. 709 luminance of every pixel. Alpha is ignored.
Image<float> luminanceOf(const Image<glm::vec4>& image);
Image<float> channelOf(const Image<glm::vec4>& image, int channel);

/// Returns the number of pixels of a mask that count.
std::size_t countOf(const Mask& mask);
Mask both(const Mask& a, const Mask& b);                   ///< where the two are
Image<float> within(Image<float> image, const Mask& mask); ///< 0 where the mask is

/// Returns the mean of a map, with a mask over its pixels. Throws std::logic_error if none counts,
/// or the mask is of another size.
double meanOf(const Image<float>& map, const Mask* mask = nullptr);

/// A measure of each pixel, and its mean over those that count.
struct MeasuredImage {
    Image<float> map;
    double mean = 0.0;
};

// The measures below compare linear images of equal size. Of a color image they average over red,
// green and blue of every pixel, and ignore alpha; for the error of luminance, pass luminanceOf().
// With a mask only its pixels count, in every mean. Sums are in double precision. Images of unequal
// size, or none that counts, are a std::logic_error. A NaN in an image that counts gives NaN.

/// Returns the root of the mean squared error, in the images' unit.
double rmse(const Image<float>& image, const Image<float>& reference, const Mask* mask = nullptr);
double rmse(const Image<glm::vec4>& image, const Image<glm::vec4>& reference,
            const Mask* mask = nullptr);

/// Returns the relative mean squared error: the mean of (x - r)^2 / (r^2 + 0.01 m), where m is the
/// mean of r^2. Without the second term a few dark pixels would outvote all others; being relative
/// itself, it makes the measure independent of exposure. A black reference gives 0 if the image is
/// black as well, else infinity.
double relMse(const Image<float>& image, const Image<float>& reference, const Mask* mask = nullptr);
double relMse(const Image<glm::vec4>& image, const Image<glm::vec4>& reference,
              const Mask* mask = nullptr);

/// Returns the peak signal to noise ratio in dB: 20 log10(peak / rmse). Infinity for equal images.
double psnr(const Image<float>& image, const Image<float>& reference, double peak = 1.0,
            const Mask* mask = nullptr);
double psnr(const Image<glm::vec4>& image, const Image<glm::vec4>& reference, double peak = 1.0,
            const Mask* mask = nullptr);
/// Returns that of display pixels as they are, with a peak of 255.
double psnr(const Image<glm::u8vec4>& image, const Image<glm::u8vec4>& reference,
            const Mask* mask = nullptr);

/// Returns how wrongly an image moves: the RMSE between its change since the frame before and the
/// reference's change. A constant error does not count.
double temporalError(const Image<glm::vec4>& now, const Image<glm::vec4>& before,
                     const Image<glm::vec4>& referenceNow, const Image<glm::vec4>& referenceBefore,
                     const Mask* mask = nullptr);

/// The flicker that an eye sees while nothing changes: the mean over pixels, and red, green and
/// blue, of the standard deviation over time (of the population: divided by the number of frames).
/// It keeps sums instead of frames.
class Flicker {
public:
    /// Adds a frame. Throws std::logic_error if it is not of the size of the first. Alpha is
    /// ignored.
    void add(const Image<glm::vec4>& frame);

    int frames() const { return frames_; }

    /// Returns the flicker of all frames so far; of one it is 0. Throws std::logic_error before the
    /// first, or if no pixel counts.
    double mean(const Mask* mask = nullptr) const;

private:
    int frames_ = 0;
    Image<glm::dvec3> mean_;    ///< over time
    Image<glm::dvec3> squares_; ///< the sum of the squared differences from the mean
};

} // namespace afterglow
