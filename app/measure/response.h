// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/image/metrics.h"

#include <optional>
#include <span>
#include <vector>

namespace afterglow {

/// A change of the picture from one converged image to another, over the mask of the pixels where
/// it matters. All images are linear rgb, before TAA and tone mapping, of one size and at one
/// exposure; alpha is ignored. They leave out what bypasses the filter: a light that is seen itself
/// changes by far the most, at once, and would be all that is in the mask.
class PictureChange {
public:
    /// The mask holds the pixels that change by more than 2 % of the greatest change (lengths of
    /// rgb differences), of those that count. Empty if no pixel changes, or if the references hold
    /// a value that is not finite.
    static std::optional<PictureChange> between(Image<glm::vec4> before, Image<glm::vec4> after,
                                                const Mask* counts = nullptr);

    const Mask& mask() const { return mask_; }

    /// The response p of a frame: 0 is stale, 1 is fully adapted. The frame's difference from the
    /// old reference, projected on the change. Noise that is unbiased hardly moves it: the sum over
    /// the mask averages it away.
    double response(const Image<glm::vec4>& frame) const;

    /// The RMSE against the new reference over the mask, with the projected lag taken out. What is
    /// left is noise, and bias of any other shape than the change itself.
    double noise(const Image<glm::vec4>& frame) const;

    /// How much of the old picture is still shown: the sum, over the mask, of the errors that point
    /// back to it, in shares of the sum of all changes. Noise counts too, by half of its mean
    /// absolute value; response() is free of that.
    double ghostEnergy(const Image<glm::vec4>& frame) const;

private:
    PictureChange(Image<glm::vec4> before, Image<glm::vec4> after, Mask mask, double energy)
        : before_(std::move(before)), after_(std::move(after)), mask_(std::move(mask)),
          energy_(energy) {}

    Image<glm::vec4> before_, after_;
    Mask mask_;
    double energy_; ///< the sum of squared changes over the mask, > 0
};

// A response curve p holds one value per frame: p[0] is the event's own frame, and the last is the
// last of the run or of the frames before the next event.

/// The number of frames after the event (its own counts as 0) from which p stays above `level` to
/// the curve's end. Empty: never.
std::optional<int> framesUntilAbove(std::span<const double> p, double level);

/// The area above the curve: the sum of max(0, 1 - p). The frames' worth of old light that was
/// shown.
double ghostFrames(std::span<const double> p);

/// The number of frames after the event from which the noise stays within `tolerance` (relative) of
/// its settled value to the curve's end. Empty: never.
std::optional<int> framesUntilSettled(std::span<const double> noise, double settled,
                                      double tolerance = 0.1);

/// The mean of the last `window` values, or of all if there are fewer. At least one of each.
double settledValue(std::span<const double> values, int window);

/// The numbers that stand for a response curve of at least one frame.
struct ResponseSummary {
    std::optional<int> t50, t90, t99; ///< frames; empty: never
    double ghostFrames = 0.0;         ///< frames
    double overshoot = 0.0;           ///< max(p) - 1; negative where p stays below 1
};

ResponseSummary summarize(std::span<const double> p);

/// The same curve between the filter's own settled values: `start` before the event, `end` long
/// after it. A filter that blurs, or is biased in any other way, never comes to 1; its lag is how
/// long it takes to where it will stay. Empty where the two are closer than 5 % of the step, so
/// that noise would be all there is to see.
std::optional<std::vector<double>> betweenOwnValues(std::span<const double> p, double start,
                                                    double end);

} // namespace afterglow
