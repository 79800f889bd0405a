// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/filters/filter.h"
#include "renderer/filters/svgf_plan.h"
#include "renderer/passes/atrous_pass.h"
#include "renderer/passes/change_pass.h"
#include "renderer/passes/gradient_pass.h"
#include "renderer/passes/luminance_range_pass.h"
#include "renderer/passes/temporal_pass.h"
#include "renderer/passes/variance_pass.h"

namespace afterglow {

/// SVGF and its relatives: none, fixed, svgf, asvgf, clamp, percentile, confidence, counted.
const FilterFamily& svgfFamily();

/// The images of the family, by their places.
namespace svgf {
enum Image : std::size_t {
    kColor,           ///< what the next frame takes as its history
    kMoments,         ///< mean of l, mean of l^2, history length
    kGradientSamples, ///< as measured
    kGradient0,       ///< reconstructed in turns; the result is the first
    kGradient1,
    kLambda,
    kLuminanceRange,
    kAccumulated, ///< the blend, unless it is kColor
    kControl,     ///< lambda, alpha, history length, reason
    kFiltered0,
    kFiltered1,
    // Pairs of light, before, now and products: as measured, and reconstructed in turns, the result
    // in the second three.
    kBefore,
    kNow,
    kProducts,
    kBefore0,
    kNow0,
    kProducts0,
    kBefore1,
    kNow1,
    kProducts1,
    kChange,
    kChanged
};
/// Returns the image that holds the temporal blend: the history itself where nothing is fed back
/// from the spatial filter.
Image blendOf(const SvgfPlan& plan);
/// The inputs of the family's passes.
TemporalPass::Inputs temporalInputs(const FilterInput& in, FilterImages own);
gpu::TemporalParams temporalParams(const FilterInput& in, const SvgfPlan& plan);
GradientPass::Inputs gradientInputs(const FilterInput& in);
} // namespace svgf

/// Runs the plan of a filter of the family.
class SvgfFilter : public SignalFilter {
public:
    explicit SvgfFilter(ShaderLibrary& shaders);

    const GpuTexture& run(FrameContext& frame, const FilterInput& in,
                          const FilterSettings& settings, FilterImages own) override;
    /// The same with any plan, for filters that are composed of this one.
    const GpuTexture& run(FrameContext& frame, const FilterInput& in, const SvgfPlan& plan,
                          FilterImages own);

private:
    struct Run {
        FrameContext& frame;
        const FilterInput& in;
        const SvgfPlan& plan;
        FilterImages& own;
    };
    void reconstructGradient(const Run& run);
    void reconstructChange(const Run& run);
    void accumulate(const Run& run);
    const GpuTexture& filter(const Run& run);
    AtrousPass& atrousOf(const SvgfPlan& plan);
    GradientAtrousPass& gradientAtrousOf(const SvgfPlan& plan);

    GradientPass gradient_;
    GradientAtrousPass gradientSpline_, gradientBox_;
    LambdaPass lambda_;
    LightPairsPass lightPairs_;
    LightPairsAtrousPass lightPairsAtrous_;
    ChangePass change_;
    LuminanceRangePass luminanceRange_;
    TemporalPass temporal_;
    VariancePass variance_;
    AtrousPass atrousSpline_, atrousBox_;
};

} // namespace afterglow
