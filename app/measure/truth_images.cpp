// SPDX-License-Identifier: MIT
#include "app/measure/truth_images.h"

#include <algorithm>

namespace afterglow {
namespace {

using G = ImageGroup;
using From = const TruthSources&;
using Colors = Image<glm::vec4>;

Colors inColors(const Image<float>& values) {
    Colors colors(values.size());
    std::ranges::transform(values.pixels(), colors.pixels().begin(),
                           [](float value) { return glm::vec4(value, 0.0f, 0.0f, 0.0f); });
    return colors;
}

/// a - b where the mask counts, else 0.
Colors difference(const Image<float>& a, const Image<float>& b, const Mask& counts) {
    Image<float> result(a.size());
    for (std::size_t i = 0; i < result.pixels().size(); ++i)
        if (counts.pixels()[i] != 0)
            result.pixels()[i] = a.pixels()[i] - b.pixels()[i];
    return inColors(result);
}

Colors lambda(From from, std::size_t signal, bool isError) {
    const Image<float>& own = from.images.control.at(signal).lambda;
    if (own.size().x == 0 || !from.hasBefore)
        return {};
    const StrataTruth ideal = from.truth.idealLambda(signal, from.deltaFloor);
    return isError ? difference(own, ideal.lambda, ideal.lit) : inColors(ideal.lambda);
}

Colors alpha(From from, std::size_t signal, bool isError) {
    const ControlImages& own = from.images.control.at(signal);
    if (own.alpha.size().x == 0)
        return {};
    const Image<float> ideal = from.truth.idealAlpha(signal, own.history, own.hasHistory);
    return isError ? difference(own.alpha, ideal, both(own.hasHistory, from.truth.foreground))
                   : inColors(ideal);
}

// clang-format off
constexpr std::array kRows = std::to_array<TruthImage>({
    {{"error", "luminance of the picture minus that of the reference: orange is too bright, blue too dark", "Y",
      G::Truth, aroundZero(0.2f, "radiance")},
     [](From from, std::size_t) {
         return difference(luminanceOf(from.images.lit), luminanceOf(from.truth.lit), from.truth.foreground);
     }},
    {{"reference", "the converged picture of this frame, without emission", "RGB", G::Truth, radiance()},
     [](From from, std::size_t) { return from.truth.lit; }},
    {{"ideal lambda", "the share of the light that truly changed in each stratum since the frame before", "Y",
      G::Truth, linear(0.0f, 1.0f), kPerSignal, kPerStratum},
     [](From from, std::size_t signal) { return lambda(from, signal, false); }},
    {{"lambda error", "lambda minus the ideal one: orange are false alarms, blue is change that was missed", "Y",
      G::Truth, aroundZero(1.0f), kPerSignal, kPerStratum},
     [](From from, std::size_t signal) { return lambda(from, signal, true); }},
    {{"ideal alpha", "the weight of the newest sample that leaves the least expected error", "Y",
      G::Truth, linear(0.0f, 1.0f), kPerSignal},
     [](From from, std::size_t signal) { return alpha(from, signal, false); }},
    {{"alpha error", "alpha minus the ideal one: orange is needless noise, blue is lag", "Y",
      G::Truth, aroundZero(1.0f), kPerSignal},
     [](From from, std::size_t signal) { return alpha(from, signal, true); }},
});
// clang-format on

} // namespace

std::span<const TruthImage> truthImages() {
    return kRows;
}

} // namespace afterglow
