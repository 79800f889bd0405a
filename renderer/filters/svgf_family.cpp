// SPDX-License-Identifier: MIT
// Declares the images and the AOVs of SVGF and its relatives.

#include "renderer/filters/svgf_filter.h"

#include <array>

namespace afterglow {
namespace {

using namespace svgf;

// In the order of svgf::Image.
constexpr std::array kImages{
    ImageDecl{"color", PixelFormat::RGBA32F, ImageGrid::Pixels, true},
    ImageDecl{"moments", PixelFormat::RGBA32F, ImageGrid::Pixels, true},
    ImageDecl{"gradient samples", PixelFormat::RGBA32F, ImageGrid::Strata},
    ImageDecl{"gradient 0", PixelFormat::RGBA32F, ImageGrid::Strata},
    ImageDecl{"gradient 1", PixelFormat::RGBA32F, ImageGrid::Strata},
    ImageDecl{"lambda", PixelFormat::R32F, ImageGrid::Strata},
    ImageDecl{"luminance range", PixelFormat::RGBA32F, ImageGrid::Tiles},
    ImageDecl{"accumulated", PixelFormat::RGBA32F},
    ImageDecl{"control", PixelFormat::RGBA32F},
    ImageDecl{"filtered 0", PixelFormat::RGBA32F},
    ImageDecl{"filtered 1", PixelFormat::RGBA32F},
    ImageDecl{"light before", PixelFormat::RGBA32F, ImageGrid::Strata},
    ImageDecl{"light now", PixelFormat::RGBA32F, ImageGrid::Strata},
    ImageDecl{"light products", PixelFormat::RGBA32F, ImageGrid::Strata},
    ImageDecl{"light before 0", PixelFormat::RGBA32F, ImageGrid::Strata},
    ImageDecl{"light now 0", PixelFormat::RGBA32F, ImageGrid::Strata},
    ImageDecl{"light products 0", PixelFormat::RGBA32F, ImageGrid::Strata},
    ImageDecl{"light before 1", PixelFormat::RGBA32F, ImageGrid::Strata},
    ImageDecl{"light now 1", PixelFormat::RGBA32F, ImageGrid::Strata},
    ImageDecl{"light products 1", PixelFormat::RGBA32F, ImageGrid::Strata},
    ImageDecl{"change", PixelFormat::RGBA32F, ImageGrid::Strata},
    ImageDecl{"changed", PixelFormat::R32UI, ImageGrid::One},
};
static_assert(kImages.size() == kChanged + 1);

using S = const FilterSettings&;

bool always(S) {
    return true;
}
bool whereAccumulated(S s) {
    return makePlan(s).accumulate;
}
bool whereFiltered(S s) {
    return makePlan(s).atrousIterations > 0;
}
bool whereAdaptive(S s) {
    return makePlan(s).useLambda;
}
bool whereLambda(S s) {
    const SvgfPlan plan = makePlan(s);
    return plan.useLambda || plan.usePercentiles;
}
bool whereGradient(S s) {
    const SvgfPlan plan = makePlan(s);
    return plan.useLambda && !plan.useChange;
}
bool whereReconstructed(S s) {
    return whereGradient(s) && makePlan(s).gradientIterations > 0;
}
bool whereChange(S s) {
    return makePlan(s).useChange;
}
bool whereCounted(S s) {
    return makePlan(s).countsSamples();
}
template <std::size_t measured, std::size_t reconstructed>
std::size_t pairs(S s) {
    return makePlan(s).gradientIterations > 0 ? reconstructed : measured;
}

template <std::size_t place>
std::size_t at(S) {
    return place;
}
std::size_t blend(S s) {
    return blendOf(makePlan(s));
}

using G = ImageGroup;

// clang-format off
constexpr std::array kAovs = std::to_array<FilterAov>({
    {{"filtered", "the signal after the filter, without albedo, radiance", "RGB", G::Filter, radiance(), kPerSignal},
     always, at<kFilterResult>},
    {{"variance", "variance of the filtered signal's luminance, as estimated, radiance squared", "Y",
      G::Filter, logarithmic(1e-5f, 1.0f, "radiance squared"), kPerSignal}, whereFiltered, at<kFilterResult>, 3},
    {{"accumulated", "the signal after temporal and before spatial filtering, radiance", "RGB",
      G::Filter, radiance(), kPerSignal}, whereAccumulated, blend},
    {{"history_luminance", "luminance of the history as fetched, 0 without one, radiance", "Y",
      G::Filter, linear(0.0f, 1.0f, "radiance"), kPerSignal}, whereAccumulated, blend, 3},
    {{"moments", "running means of the raw luminance and of its square", "XY",
      G::History, logarithmic(1e-3f, 10.0f, "radiance"), kPerSignal}, whereAccumulated, at<kMoments>},
    {{"history", "length of the history as the history law counts it, frames", "Y",
      G::History, logarithmic(1.0f, 128.0f, "frames"), kPerSignal}, whereAccumulated, at<kMoments>, 2},
    {{"alpha", "weight of the newest frame in the blend, [0, 1]", "Y", G::History, linear(0.0f, 1.0f), kPerSignal},
     whereAccumulated, at<kControl>, 1},
    {{"reason", "why there is no history: 0 there is, 1 first frame, 2 off screen, 3 another "
      "instance, 4 depth, 5 normal", "Y", G::History, numbersUpTo(5.0f), kPerSignal}, whereAccumulated, at<kControl>, 3},
    {{"lambda", "relative temporal change as fetched at the pixel, [0, 1]", "Y",
      G::Change, linear(0.0f, 1.0f), kPerSignal}, whereLambda, at<kControl>},
    {{"lambda_strata", "relative temporal change per stratum of 3x3 pixels, [0, 1]", "Y",
      G::Change, linear(0.0f, 1.0f), kPerSignal, kPerStratum}, whereAdaptive, at<kLambda>},
    {{"gradient", "reconstructed change of luminance (delta), or its size, per stratum, radiance", "Y",
      G::Change, aroundZero(0.5f, "radiance"), kPerSignal, kPerStratum}, whereReconstructed, at<kGradient0>},
    {{"gradient_max", "reconstructed larger luminance of the two frames (Delta) per stratum, radiance", "Y",
      G::Change, linear(0.0f, 1.0f, "radiance"), kPerSignal, kPerStratum}, whereReconstructed, at<kGradient0>, 1},
    {{"gradient_sample", "change of luminance at each stratum's sample, or its size, as measured, radiance", "Y",
      G::Change, aroundZero(0.5f, "radiance"), kPerSignal, kPerStratum}, whereGradient, at<kGradientSamples>},
    {{"gradient_sample_max", "larger luminance of the two frames at each stratum's sample, radiance", "Y",
      G::Change, linear(0.0f, 1.0f, "radiance"), kPerSignal, kPerStratum}, whereGradient, at<kGradientSamples>, 1},
    {{"light_before", "reconstructed light of the gradient samples in the frame before, times the share of strata "
      "that have one, per stratum, radiance", "RGB", G::Change, radiance(), kPerSignal, kPerStratum},
     whereChange, pairs<kBefore, kBefore0>},
    {{"light_now", "the same light in this frame, per stratum, radiance", "RGB", G::Change, radiance(), kPerSignal,
      kPerStratum}, whereChange, pairs<kNow, kNow0>},
    {{"change_left", "squared relative change that the history has after it was scaled (E), per stratum", "Y",
      G::Change, linear(0.0f, 1.0f), kPerSignal, kPerStratum}, whereCounted, at<kChange>},
    {{"change_variance", "relative variance of one sample (v), per stratum", "Y",
      G::Change, logarithmic(0.01f, 10.0f, ""), kPerSignal, kPerStratum}, whereCounted, at<kChange>, 1},
    {{"change_scale", "factor of the light, by which the history is scaled, per stratum", "Y",
      G::Change, linear(0.0f, 2.0f), kPerSignal, kPerStratum}, whereCounted, at<kChange>, 2},
});
// clang-format on

} // namespace

const FilterFamily& svgfFamily() {
    static const FilterFamily family{
        .images = kImages,
        .aovs = kAovs,
        .needs =
            [](const FilterSettings& settings) {
                const SvgfPlan plan = makePlan(settings);
                return FilterNeeds{.samples = plan.carrySamples, .lambda = plan.useLambda};
            },
        .make = [](ShaderLibrary& shaders) -> std::unique_ptr<SignalFilter> {
            return std::make_unique<SvgfFilter>(shaders);
        }};
    return family;
}

} // namespace afterglow
