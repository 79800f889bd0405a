#include "renderer/pipeline/aov.h"

#include "renderer/base/names.h"

#include <array>
#include <stdexcept>
#include <vector>

namespace afterglow {

namespace {

using MadeBy = bool(const DenoisePlan&);

bool always(const DenoisePlan&) {
    return true;
}
bool whereAccumulated(const DenoisePlan& plan) {
    return plan.accumulate;
}
bool whereFiltered(const DenoisePlan& plan) {
    return plan.atrousIterations > 0;
}
// With nothing fed back from the spatial filter the blend is the history itself.
bool whereBlendIsKept(const DenoisePlan& plan) {
    return plan.feedbackIteration > 0;
}
bool whereAdaptive(const DenoisePlan& plan) {
    return plan.useLambda;
}
bool whereLambda(const DenoisePlan& plan) {
    return plan.useLambda || plan.usePercentiles;
}
bool whereReconstructed(const DenoisePlan& plan) {
    return plan.useLambda && plan.gradientIterations > 0;
}
bool whereCarried(const DenoisePlan& plan) {
    return plan.carrySamples;
}

struct Row {
    AovInfo info;
    AovSource (*source)(const Renderer&, std::size_t state);
    MadeBy* madeBy;
};

using R = const Renderer&;
constexpr bool kPerStratum = true;

// clang-format off
const std::array kRows = std::to_array<Row>({
    {{"color", "linear radiance: the filtered signal times albedo, plus emission", "RGB"},
     [](R r, std::size_t i) { return AovSource{r.targets().filters[i].composed}; }, always},
    {{"filtered", "the signal after the filter, without albedo, radiance", "RGB"},
     [](R r, std::size_t i) { return AovSource{r.filteredSignal(i)}; }, always},
    {{"raw", "the signal as traced, one sample a pixel, without albedo, radiance", "RGB"},
     [](R r, std::size_t) { return AovSource{r.targets().raw.current()}; }, always},
    {{"accumulated", "the signal after temporal and before spatial filtering, radiance", "RGB"},
     [](R r, std::size_t i) { return AovSource{r.targets().filters[i].accumulated}; }, whereBlendIsKept},
    {{"history_luminance", "luminance of the history as fetched, 0 without one, radiance", "Y"},
     [](R r, std::size_t i) { return AovSource{r.targets().filters[i].accumulated, 3}; }, whereBlendIsKept},
    {{"variance", "variance of the filtered signal's luminance, as estimated, radiance squared", "Y"},
     [](R r, std::size_t i) { return AovSource{r.filteredSignal(i), 3}; }, whereFiltered},
    {{"albedo", "diffuse reflectance of the surface, [0, 1]", "RGB"},
     [](R r, std::size_t) { return AovSource{r.targets().albedo}; }, always},
    {{"emission", "what the surface itself emits, radiance", "RGB"},
     [](R r, std::size_t) { return AovSource{r.targets().emission}; }, always},
    {{"normal", "world-space shading normal, unit length", "XYZ"},
     [](R r, std::size_t) { return AovSource{r.targets().guides.current()}; }, always},
    {{"depth", "distance along the view axis, metres; 0 is background", "Y"},
     [](R r, std::size_t) { return AovSource{r.targets().guides.current(), 3}; }, always},
    {{"position", "of the surface in the world, metres", "XYZ"},
     [](R r, std::size_t) { return AovSource{r.targets().surface, 0, true}; }, always},
    {{"slope", "change of depth along x and y, metres per pixel", "XY"},
     [](R r, std::size_t) { return AovSource{r.targets().slope}; }, always},
    {{"motion", "from the pixel to where its surface was a frame ago, pixels", "XY"},
     [](R r, std::size_t) { return AovSource{r.targets().motion}; }, always},
    {{"instance", "number of the instance from 1; 0 is background", "Y"},
     [](R r, std::size_t) { return AovSource{r.targets().visibility.current()}; }, always},
    {{"moments", "running means of the raw luminance and of its square", "XY"},
     [](R r, std::size_t i) { return AovSource{r.targets().filters[i].moments.current()}; }, whereAccumulated},
    {{"history", "length of the history as the history law counts it, frames", "Y"},
     [](R r, std::size_t i) { return AovSource{r.targets().filters[i].moments.current(), 2}; }, whereAccumulated},
    {{"alpha", "weight of the newest frame in the blend, [0, 1]", "Y"},
     [](R r, std::size_t i) { return AovSource{r.targets().filters[i].control, 1}; }, whereAccumulated},
    {{"reason", "why there is no history: 0 there is, 1 first frame, 2 off screen, 3 another "
      "instance, 4 depth, 5 normal", "Y"},
     [](R r, std::size_t i) { return AovSource{r.targets().filters[i].control, 3}; }, whereAccumulated},
    {{"lambda", "relative temporal change as fetched at the pixel, [0, 1]", "Y"},
     [](R r, std::size_t i) { return AovSource{r.targets().filters[i].control}; }, whereLambda},
    {{"lambda_strata", "relative temporal change per stratum of 3x3 pixels, [0, 1]", "Y", kPerStratum},
     [](R r, std::size_t i) { return AovSource{r.targets().filters[i].lambda}; }, whereAdaptive},
    {{"gradient", "reconstructed change of luminance (delta), or its size, per stratum, radiance", "Y", kPerStratum},
     [](R r, std::size_t i) { return AovSource{r.targets().filters[i].gradient[0]}; }, whereReconstructed},
    {{"gradient_max", "reconstructed larger luminance of the two frames (Delta) per stratum, radiance",
      "Y", kPerStratum},
     [](R r, std::size_t i) { return AovSource{r.targets().filters[i].gradient[0], 1}; }, whereReconstructed},
    {{"gradient_sample", "change of luminance at each stratum's sample, or its size, as measured, radiance", "Y",
      kPerStratum},
     [](R r, std::size_t i) { return AovSource{r.targets().filters[i].gradientSamples}; }, whereAdaptive},
    {{"gradient_sample_max", "larger luminance of the two frames at each stratum's sample, radiance",
      "Y", kPerStratum},
     [](R r, std::size_t i) { return AovSource{r.targets().filters[i].gradientSamples, 1}; }, whereAdaptive},
    {{"samples", "where in the stratum its gradient sample landed, 1 + x + 3y; 0 is none", "Y",
      kPerStratum},
     [](R r, std::size_t) { return AovSource{r.targets().samples, 1}; }, whereCarried},
    {{"fate", "what became of the sample that each stratum of the frame before offered: 1 carried, 2 "
      "background, 3 a gradient sample itself, 4 off screen, 5 another instance, 6 depth, 7 lost the "
      "race", "Y", kPerStratum},
     [](R r, std::size_t) { return AovSource{r.targets().samples, 3}; }, whereCarried},
});
// clang-format on

const std::array kInfos = [] {
    std::array<AovInfo, kRows.size()> infos;
    for (std::size_t i = 0; i < kRows.size(); ++i)
        infos[i] = kRows[i].info;
    return infos;
}();

const Row& rowOf(const AovInfo& aov) {
    for (const Row& row : kRows)
        if (row.info.name == aov.name)
            return row;
    throw std::logic_error("no AOV named " + std::string(aov.name));
}

/// `count` channels of each pixel, from the source's first one on.
template <class Pixel>
Image<glm::vec4> channelsOf(const AovSource& source, int count) {
    const Image<Pixel> from = source.texture.read<Pixel>();
    Image<glm::vec4> to(from.size());
    for (std::size_t i = 0; i < to.pixels().size(); ++i)
        for (int channel = 0; channel < count; ++channel) {
            const auto value = [&] {
                if constexpr (std::is_arithmetic_v<Pixel>)
                    return from.pixels()[i];
                else
                    return from.pixels()[i][source.channel + channel];
            }();
            to.pixels()[i][channel] =
                source.isFloatBits ? glm::uintBitsToFloat(std::uint32_t(value)) : float(value);
        }
    return to;
}

} // namespace

std::span<const AovInfo> aovs() {
    return kInfos;
}

const AovInfo& aovByName(std::string_view name) {
    std::vector<std::string_view> known;
    for (const AovInfo& aov : kInfos) {
        if (aov.name == name)
            return aov;
        known.push_back(aov.name);
    }
    throwUnknownName("AOV", name, known);
}

bool isMadeBy(const AovInfo& aov, Filter filter, const DenoiserSettings& settings) {
    return rowOf(aov).madeBy(makePlan(filter, settings));
}

AovSource sourceOf(const Renderer& renderer, const AovInfo& aov, std::size_t state) {
    return rowOf(aov).source(renderer, state);
}

Image<glm::vec4> readAov(const Renderer& renderer, const AovInfo& aov, std::size_t state) {
    const AovSource source = sourceOf(renderer, aov, state);
    const int count = int(aov.channels.size());
    switch (source.texture.format()) {
    case PixelFormat::RGBA32F: return channelsOf<glm::vec4>(source, count);
    case PixelFormat::RG32F: return channelsOf<glm::vec2>(source, count);
    case PixelFormat::R32F: return channelsOf<float>(source, count);
    case PixelFormat::RGBA32UI: return channelsOf<glm::uvec4>(source, count);
    default: throw std::logic_error("no AOV is kept in " + source.texture.label());
    }
}

} // namespace afterglow
