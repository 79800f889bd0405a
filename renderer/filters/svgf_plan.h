// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/filters/filter_settings.h"

namespace afterglow {

/// The passes of SVGF or one of its relatives in one frame, with their parameters. Filters of the
/// family differ in these values and in nothing else.
struct SvgfPlan {
    bool accumulate = false;     ///< temporal accumulation; without it the raw signal is shown
    bool carrySamples = false;   ///< shade some of the last frame's samples again, with their seeds
    bool useLambda = false;      ///< lambda per pixel, from the gradient of those samples
    bool useChange = false;      ///< that lambda from the change of light by channel
    bool usePercentiles = false; ///< lambda per pixel, from percentiles of the raw luminance

    gpu::TemporalParams temporal{};
    gpu::PercentileParams percentiles{};

    gpu::GradientParams gradient{};
    gpu::EdgeStopping gradientEdges{};           ///< but for the step, which gradientStep() gives
    int gradientIterations = 0;                  ///< of the reconstruction of the gradient
    Kernel gradientKernel = Kernel::B3Spline5x5; ///< of each of them
    bool gradientStridesLinear = false;          ///< steps of 1, 2, 3, ... instead of 1, 2, 4, ...
    gpu::ChangeParams change{};                  ///< with useChange

    gpu::VarianceParams variance{};
    gpu::EdgeStopping edges{};           ///< of the spatial filter; the steps are 1, 2, 4, ...
    int atrousIterations = 0;            ///< of the spatial filter, guided by variance; 0: none
    Kernel kernel = Kernel::B3Spline5x5; ///< of each of them
    int feedbackIteration = 0; ///< whose result becomes the history; 0: the unfiltered blend

    bool countsSamples() const { return temporal.lambdaUse == gpu::kLambdaCounts; }
    bool cutsHistory() const { return temporal.lambdaUse == gpu::kLambdaCuts; }
    /// Returns whether lambda makes the history shorter before it is blended, and blends as well.
    bool cutsByPower() const {
        return temporal.lambdaUse == gpu::kLambdaBlends &&
               temporal.historyLaw == gpu::kHistoryPower && (useLambda || usePercentiles);
    }
    bool clampsHistory() const { return temporal.clampRadius >= 0; }
    int gradientStep(int iteration) const {
        return gradientStridesLinear ? iteration + 1 : 1 << iteration;
    }
};

/// The plan of a filter of SVGF's family.
SvgfPlan makePlan(const FilterSettings& settings);

} // namespace afterglow
