// SPDX-License-Identifier: MIT
#include "renderer/pipeline/aov.h"

#include "renderer/base/names.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

namespace afterglow {

namespace {

struct Row {
    AovInfo info;
    AovSource (*source)(const Renderer&, std::size_t state, std::size_t signal);
};

using R = const Renderer&;
using G = ImageGroup;

// clang-format off
const std::array kRows = std::to_array<Row>({
    {{"color", "linear radiance: the filtered signal times albedo, plus emission", "RGB", G::Light, radiance()},
     [](R r, std::size_t i, std::size_t) { return AovSource{r.targets().filters[i].composed}; }},
    {{"antialiased", "color averaged over time, where there is temporal anti-aliasing; else color", "RGB", G::Light, radiance()},
     [](R r, std::size_t i, std::size_t) {
         const FilterTargets& shown = r.targets().filters[i];
         const GpuTexture& resolved = shown.resolved.current();
         return AovSource{resolved.size().x != 0 ? resolved : shown.composed};
     }},
    {{"raw", "the signal as traced, one sample a pixel, without albedo, radiance", "RGB", G::Light, radiance(), kPerSignal},
     [](R r, std::size_t, std::size_t s) { return AovSource{r.targets().signals[s].raw.current()}; }},
    {{"albedo", "diffuse reflectance of the surface, [0, 1]", "RGB", G::Surfaces, {gpu::kMapRadiance}},
     [](R r, std::size_t, std::size_t) { return AovSource{r.targets().surfaces.albedo}; }},
    {{"emission", "what the surface itself emits, radiance", "RGB", G::Surfaces, radiance(10.0f)},
     [](R r, std::size_t, std::size_t) { return AovSource{r.targets().surfaces.emission}; }},
    {{"normal", "world-space shading normal, unit length", "XYZ", G::Surfaces, {gpu::kMapVector, -1.0f, 1.0f}},
     [](R r, std::size_t, std::size_t) { return AovSource{r.targets().surfaces.guides}; }},
    {{"depth", "distance along the view axis, meters; 0 is background", "Y", G::Surfaces,
      {gpu::kMapScalar, 0.0f, 0.6f, "m", true}},
     [](R r, std::size_t, std::size_t) { return AovSource{r.targets().surfaces.guides, 3}; }},
    {{"position", "of the surface in the world, meters", "XYZ", G::Surfaces, {gpu::kMapRepeat, 0.0f, 0.04f, "m", true}},
     [](R r, std::size_t, std::size_t) { return AovSource{r.targets().surfaces.surface, 0, true}; }},
    {{"slope", "change of depth along x and y, meters per pixel", "XY", G::Surfaces,
      {gpu::kMapDirection, 0.0f, 0.002f, "m per pixel", true}},
     [](R r, std::size_t, std::size_t) { return AovSource{r.targets().surfaces.slope}; }},
    {{"motion", "from the pixel to where its surface was a frame ago, pixels", "XY", G::Surfaces,
      {gpu::kMapDirection, 0.0f, 8.0f, "pixels"}},
     [](R r, std::size_t, std::size_t) { return AovSource{r.targets().surfaces.motion}; }},
    {{"instance", "number of the instance from 1; 0 is background", "Y", G::Surfaces, numbersUpTo(1.0f)},
     [](R r, std::size_t, std::size_t) { return AovSource{r.targets().surfaces.visibility}; }},
    {{"samples", "where in the stratum its gradient sample landed, 1 + x + 3y; 0 is none", "Y",
      G::Samples, numbersUpTo(9.0f), false, kPerStratum},
     [](R r, std::size_t, std::size_t) { return AovSource{r.targets().samples, 1}; }},
    {{"fate", "what became of the sample that each stratum of the frame before offered: 1 carried, 2 "
      "background, 3 a gradient sample itself, 4 off screen, 5 another instance, 6 depth, 7 lost the "
      "race", "Y", G::Samples, numbersUpTo(7.0f), false, kPerStratum},
     [](R r, std::size_t, std::size_t) { return AovSource{r.targets().samples, 3}; }},
});
// clang-format on

// Of the frame, then of all families of filters; a name that several have means the same.
const std::vector<AovInfo>& infos() {
    static const std::vector<AovInfo> all = [] {
        std::vector<AovInfo> list;
        const auto add = [&](const AovInfo& info) {
            if (std::ranges::find(list, info.name, &AovInfo::name) == list.end())
                list.push_back(info);
        };
        for (const Row& row : kRows)
            add(row.info);
        for (const FilterInfo& filter : filterTable())
            for (const FilterAov& aov : filter.family.aovs)
                add(aov.info);
        return list;
    }();
    return all;
}

const Row* frameRow(const AovInfo& aov) {
    const auto found =
        std::ranges::find(kRows, aov.name, [](const Row& row) { return row.info.name; });
    return found == kRows.end() ? nullptr : &*found;
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
    return infos();
}

const AovInfo& aovByName(std::string_view name) {
    std::vector<std::string_view> known;
    for (const AovInfo& aov : infos()) {
        if (aov.name == name)
            return aov;
        known.push_back(aov.name);
    }
    throwUnknownName("AOV", name, known);
}

bool isMadeBy(const AovInfo& aov, const FilterSettings& settings) {
    if (const Row* row = frameRow(aov))
        return row->info.group != ImageGroup::Samples || needsOf(settings).samples;
    return std::ranges::any_of(familyOf(settings.filter).aovs, [&](const FilterAov& own) {
        return own.info.name == aov.name && own.isMade(settings);
    });
}

AovSource sourceOf(const Renderer& renderer, const AovInfo& aov, std::size_t state,
                   std::size_t signal) {
    if (const Row* row = frameRow(aov))
        return row->source(renderer, state, signal);
    const Renderer::FilterImage image = renderer.filterImage(aov.name, state, signal);
    if (!image.texture)
        throw std::logic_error("the last frame has no AOV named " + std::string(aov.name));
    return {*image.texture, image.channel};
}

Image<glm::vec4> readAov(const Renderer& renderer, const AovInfo& aov, std::size_t state,
                         std::size_t signal) {
    const AovSource source = sourceOf(renderer, aov, state, signal);
    const int count = int(aov.channels.size());
    switch (source.texture.format()) {
    case PixelFormat::RGBA32F: return channelsOf<glm::vec4>(source, count);
    case PixelFormat::RG32F: return channelsOf<glm::vec2>(source, count);
    case PixelFormat::R32F: return channelsOf<float>(source, count);
    case PixelFormat::RGBA32UI: return channelsOf<glm::uvec4>(source, count);
    default: throw std::logic_error("no AOV is kept in " + source.texture.label());
    }
}

std::string fileStem(const AovInfo& aov, const SignalInfo& signal, std::size_t signals) {
    std::string stem(aov.name);
    if (signals > 1 && aov.perSignal)
        stem += "_" + std::string(signal.name);
    return stem;
}

} // namespace afterglow
