#pragma once

#include "renderer/pipeline/settings.h"

namespace afterglow {

/// What a filter does in one frame. Filters differ in these values and in nothing else, so a
/// difference between two pictures is a difference between two rows.
struct DenoisePlan {
    bool accumulate = false;     ///< temporal accumulation; without it the raw signal is shown
    bool carrySamples = false;   ///< shade some of the last frame's samples again, with their seeds
    bool useLambda = false;      ///< lambda per pixel, from the gradient of those samples
    bool usePercentiles = false; ///< lambda per pixel, from percentiles of the raw luminance
    int historyLaw = gpu::kHistoryEffective; ///< how its length follows
    bool cutHistory = false;                 ///< lambda cuts the history length instead of blending
    bool clampHistory = false;               ///< to the neighborhood of the raw signal
    int gradientIterations = 0;              ///< of the reconstruction of the gradient
    Kernel gradientKernel = Kernel::B3Spline5x5; ///< of each of them
    bool gradientStridesLinear = false;          ///< steps of 1, 2, 3, ... instead of 1, 2, 4, ...
    bool gradientAbsolute = false;               ///< |delta| instead of delta
    bool gradientLuminanceStop = false; ///< its edge stop on luminance, beside those on geometry
    int atrousIterations = 0;           ///< of the spatial filter, guided by variance; 0: none
    int feedbackIteration = 0; ///< whose result becomes the history; 0: the unfiltered blend

    bool operator==(const DenoisePlan&) const = default;
};

DenoisePlan makePlan(Filter filter, const DenoiserSettings& settings);
bool carriesSamples(const Settings& settings); ///< whether such a filter wants gradient samples

} // namespace afterglow
