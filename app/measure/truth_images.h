// SPDX-License-Identifier: MIT
#pragma once

#include "app/measure/meter.h"

namespace afterglow {

/// A filter's result for a frame, beside the frame's ground truth.
struct TruthSources {
    const Truth& truth;
    bool hasBefore; ///< there was a frame before, so lambda means something
    const FrameImages& images;
    float deltaFloor; ///< the filter's; see idealLambda()
};

/// An image that compares a filter with the ground truth: a row of the images to look at, and what
/// makes it.
struct TruthImage {
    AovInfo info;
    /// Returns the image, in as many channels as it has. Empty where the filter has no such thing:
    /// no history, no lambda from gradients. 0 on the background, where there is no light in either
    /// frame (error of lambda), and where there is no history (error of alpha).
    Image<glm::vec4> (*make)(const TruthSources& from, std::size_t signal);
};
std::span<const TruthImage> truthImages();

} // namespace afterglow
